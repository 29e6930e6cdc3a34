#include "tools/evaluate/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <unistd.h>
#include <utility>

namespace goalmouth {
namespace {

std::string clock_time(double seconds) {
    const auto whole = static_cast<long>(std::ceil(std::min(seconds, 3.6e8)));
    char text[32];
    if (whole >= 3600)
        std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
    else
        std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
    return text;
}

}  // namespace

std::string progress_line(std::size_t done, std::size_t count, const std::string& things, double seconds) {
    constexpr int width = 30;
    const double share = count > 0 ? static_cast<double>(done) / static_cast<double>(count) : 1.0;
    std::string bar(width, ' ');
    const int filled = static_cast<int>(share * width);
    for (int i = 0; i < filled; ++i) bar[static_cast<std::size_t>(i)] = '=';
    if (filled < width) bar[static_cast<std::size_t>(filled)] = '>';
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, "]  %3d %%  %zu/%zu ", static_cast<int>(100.0 * share), done,
                  count);
    std::string line = "[" + bar + numbers + things;
    if (done == 0 || !(seconds > 0.0)) return line;
    const double rate = static_cast<double>(done) / seconds;
    std::snprintf(numbers, sizeof numbers, "  %.1f/s", rate);
    line += numbers;
    if (done < count) line += "  " + clock_time(static_cast<double>(count - done) / rate) + " left";
    return line;
}

Progress::Progress(std::size_t count, std::string things)
    : count_(count),
      things_(std::move(things)),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      shown_(start_) {
    if (terminal_) show(start_);
}

Progress::~Progress() {
    if (terminal_) std::cerr << "\r\x1b[K" << std::flush;
}

void Progress::step(std::size_t done) {
    const std::lock_guard lock(mutex_);
    done_ += done;
    const auto now = Clock::now();
    const auto pause = terminal_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(60'000);
    if (now - shown_ >= pause) show(now);
}

void Progress::show(Clock::time_point now) {
    shown_ = now;
    const std::string line =
        progress_line(done_, count_, things_, std::chrono::duration<double>(now - start_).count());
    if (terminal_)
        std::cerr << '\r' << line << "\x1b[K" << std::flush;
    else
        std::cerr << line << '\n';
}

}  // namespace goalmouth
