#pragma once

#include <functional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace goalmouth {

/// A started program: leader of its own process group, standard output and error in one pipe, ended with
/// SIGTERM when we die. Closes its descriptors when it goes; the process is the owner's to end and to reap.
class Child {
  public:
    Child() = default;
    Child(Child&& other) noexcept;
    Child& operator=(Child&& other) noexcept;
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child();

    /// Starts `command` with `environment` ("NAME=VALUE", over ours). `registered(group)` is called before
    /// the program's first instruction runs. Returns the error number of a program that cannot be run, 0
    /// otherwise.
    int start(const std::vector<std::string>& command, const std::vector<std::string>& environment,
              const std::function<void(pid_t)>& registered);

    pid_t pid() const { return pid_; }
    /// Readable when the process ended; −1 where the kernel has no such thing.
    int end_descriptor() const { return pid_descriptor_; }
    int output_descriptor() const { return output_; }

    /// Complete lines that wait in the pipe.
    std::vector<std::string> read_lines();
    /// What is left of an incomplete line.
    std::vector<std::string> rest();

    /// True once the process ended; it stays a zombie, so that its group's number stays its own, until
    /// reap().
    bool ended() const;
    /// Its status as waitpid gives it; closes everything.
    int reap();

  private:
    void close_all();

    pid_t pid_ = 0;
    int pid_descriptor_ = -1;
    int output_ = -1;
    std::string partial_;
};

}  // namespace goalmouth
