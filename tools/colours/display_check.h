#pragma once

#include <string>
#include <sys/types.h>

namespace goalmouth {

/// Whether windows can be opened here. GUI libraries end the process where there is no display, so a child
/// tries. It stays connected as long as the object lives: an X server whose only client leaves starts anew,
/// and refuses who comes meanwhile, so keep it until the window is there. To be made while the process has
/// one thread.
class DisplayCheck {
  public:
    DisplayCheck();
    ~DisplayCheck();
    DisplayCheck(const DisplayCheck&) = delete;
    DisplayCheck& operator=(const DisplayCheck&) = delete;

    /// Why not, to stand in a sentence; "" where they can.
    const std::string& problem() const { return problem_; }

  private:
    pid_t child_ = -1;
    int socket_ = -1;
    std::string problem_;
};

}  // namespace goalmouth
