#pragma once

#include <string>

namespace goalmouth::test {

/// Controls of a V4L2 device by the names its driver gives them. Throws std::runtime_error for one it does
/// not have.
class Controls {
  public:
    explicit Controls(const std::string& device);
    ~Controls();
    Controls(const Controls&) = delete;
    Controls& operator=(const Controls&) = delete;

    /// For a button any value presses it. A menu takes the number of its entry.
    void set(const std::string& name, int value);
    /// The number of a menu's entry.
    int entry(const std::string& menu, const std::string& name);

  private:
    unsigned id_of(const std::string& name);
    int fd_;
};

}  // namespace goalmouth::test
