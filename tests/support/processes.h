#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <sys/types.h>
#include <vector>

namespace goalmouth::test {

// What tests of real processes need: the programs and graphs, and what other processes do.

std::filesystem::path program(const std::string& name);
std::filesystem::path shipped_graph(const std::string& name);
/// They are in the folder of programs.
bool have_programs(const std::vector<std::string>& names);

/// Asks again and again, with a generous limit. True once the answer is.
bool eventually(const std::function<bool()>& holds, std::chrono::seconds limit = std::chrono::seconds(30));

/// Not a zombie either.
bool process_lives(pid_t pid);
/// Processes, zombies left out, in whose environment GOALMOUTH_TEST is `mark`.
std::vector<pid_t> marked_processes(const std::string& mark);
/// The frame rings in shared memory that these processes made.
std::vector<std::string> rings_of(const std::set<pid_t>& producers);

/// A program that runs beside the test, output in one text; killed with all its group when the object goes.
class Running {
  public:
    /// Its environment says GOALMOUTH_TEST=`mark`, which those it starts inherit.
    Running(const std::vector<std::string>& command, const std::string& mark);
    ~Running();
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    void signal(int number) const;
    /// What it wrote so far.
    const std::string& output();
    bool wrote(const std::string& text) { return output().find(text) != std::string::npos; }
    /// Waits for its end; the exit code, 128 + n for signal n, −1 where it does not end within the limit.
    int wait(std::chrono::seconds limit = std::chrono::seconds(30));
    pid_t pid() const { return pid_; }

  private:
    pid_t pid_ = 0;
    int pipe_ = -1;
    bool reaped_ = false;
    std::string output_;
};

/// A mark that no other test uses.
std::string new_mark();

}  // namespace goalmouth::test
