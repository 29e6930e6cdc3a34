#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace goalmouth {

/// How far a long work is, on standard error: on a terminal a bar with share, rate and time left, redrawn a
/// few times a second and gone at the end; elsewhere a line a minute. Any thread may step.
class Progress {
  public:
    /// `things`: what is counted, e.g. "frames".
    Progress(std::size_t count, std::string things);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void step(std::size_t done = 1);

  private:
    using Clock = std::chrono::steady_clock;
    void show(Clock::time_point now);

    std::mutex mutex_;
    std::size_t count_;
    std::size_t done_ = 0;
    std::string things_;
    bool terminal_;
    Clock::time_point start_;
    Clock::time_point shown_;
};

/// The bar's line: "[=====>     ]  45 %  1620/3600 frames  12.3/s  2:41 left". `seconds`: since the start.
std::string progress_line(std::size_t done, std::size_t count, const std::string& things, double seconds);

}  // namespace goalmouth
