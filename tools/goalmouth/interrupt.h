#pragma once

namespace goalmouth {

/// While one lives, the first Ctrl-C (SIGINT) or SIGTERM only sets a flag: workers end after the work in hand
/// and what was done is kept. A second one ends the program as ever. At most one at a time.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    bool requested() const;

    /// Exit code of a command that was interrupted.
    static constexpr int exit_code = 130;
};

}  // namespace goalmouth
