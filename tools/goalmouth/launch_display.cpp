#include "tools/goalmouth/launch_display.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

namespace goalmouth {
namespace {

using Clock = std::chrono::steady_clock;
using Kind = LauncherEvent::Kind;

constexpr std::chrono::seconds table_interval{1};
constexpr std::chrono::seconds summary_interval{10};
constexpr const char* launcher_name = "goalmouth";
constexpr double silent_after = 3.0;  // [s] without STATUS, which comes every second
constexpr std::array<const char*, 6> name_colours = {"36", "33", "35", "32", "34", "96"};

/// snprintf into a string.
template <class... Arguments>
std::string print(const char* format, Arguments... arguments) {
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(), format, arguments...);
    return text.data();
}

std::string state_text(const ProcessReport& process) {
    switch (process.state) {
        case ProcessState::waiting:
            return "waits to start again";
        case ProcessState::finished:
            return "finished";
        case ProcessState::failed:
            return "failed";
        case ProcessState::stopped:
            return "stopped";
        case ProcessState::running:
            break;
    }
    if (process.status) return process.status_age > silent_after ? "silent" : "alive";
    return process.status_age > silent_after ? "runs, no status" : "starts";
}

int terminal_width() {
    winsize size{};
    return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

LaunchDisplay::LaunchDisplay(const Graph& graph, bool quiet)
    : quiet_(quiet),
      terminal_(::isatty(STDOUT_FILENO) == 1),
      colours_(terminal_ && !std::getenv("NO_COLOR")) {
    name_width_ = std::string_view(launcher_name).size();
    for (const auto& process : graph.processes) {
        names_.push_back(process.name);
        name_width_ = std::max(name_width_, process.name.size());
    }
    next_status_ = Clock::now() + (terminal_ ? table_interval : summary_interval);
}

std::string LaunchDisplay::prefix(int process) const {
    const auto index = static_cast<std::size_t>(process);
    const std::string name = process < 0 ? launcher_name : names_[index];
    const std::string padded = name + std::string(name_width_ - std::min(name_width_, name.size()), ' ');
    if (!colours_) return padded + " | ";
    const char* colour = process < 0 ? "1" : name_colours[index % name_colours.size()];
    return print("\x1b[%sm", colour) + padded + " |\x1b[0m ";
}

std::string LaunchDisplay::line_of(const LauncherEvent& event) const {
    const bool trouble = event.kind == Kind::died || event.kind == Kind::failed || event.kind == Kind::notice;
    if (quiet_ && !trouble) return {};
    std::string text = event.text;
    if (event.kind != Kind::output && event.process >= 0) {
        static const std::array<const char*, 7> words = {
            "", "started: ", "died: ", "finished: ", "failed: ", "stopped: ", ""};
        text = words[static_cast<std::size_t>(event.kind)] + text;
        if (colours_ && trouble) text = "\x1b[31m" + text + "\x1b[0m";
    }
    return prefix(event.process) + text + '\n';
}

std::string LaunchDisplay::table(const std::vector<ProcessReport>& processes) const {
    const int width = terminal_width();
    std::vector<std::string> rows;
    rows.push_back(print("%-*s  %7s  %8s  %7s  %8s  %5s  %8s  %s", static_cast<int>(name_width_), "PROCESS",
                         "RATE/s", "LATENCY", "DROPPED", "REJECTED", "CPU", "RESTARTS", "STATE"));
    for (const auto& process : processes) {
        std::string numbers = print("%7s  %8s  %7s  %8s  %5s", "", "", "", "", "");
        if (process.status) {
            const status_t& s = *process.status;
            const std::string latency = s.latency_p50 < 0 ? "" : print("%.1f ms", 1e3 * s.latency_p50);
            numbers =
                print("%7.1f  %8s  %7lld  %8lld  %4.0f%%", s.rate, latency.c_str(),
                      static_cast<long long>(s.dropped), static_cast<long long>(s.rejected), 100.0 * s.busy);
        }
        rows.push_back(print("%-*s  %s  %8d  %s", static_cast<int>(name_width_), process.name.c_str(),
                             numbers.c_str(), process.restarts, state_text(process).c_str()));
    }
    std::string text;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::string row = rows[i].substr(0, static_cast<std::size_t>(width - 1));
        text += colours_ && i == 0 ? "\x1b[7m" + row + "\x1b[0m\n" : row + '\n';
    }
    return text;
}

std::string LaunchDisplay::summary(const std::vector<ProcessReport>& processes) const {
    const auto alive = std::count_if(processes.begin(), processes.end(),
                                     [](const ProcessReport& p) { return p.state == ProcessState::running; });
    std::string text = print("%d of %zu alive", static_cast<int>(alive), processes.size());
    for (const auto& process : processes) {
        text += "; " + process.name;
        const std::string state = state_text(process);
        if (state != "alive") text += " " + state;
        if (process.status) {
            text += print(" %.1f/s", process.status->rate);
            if (process.status->latency_p50 >= 0)
                text += print(" %.1f ms", 1e3 * process.status->latency_p50);
            if (process.status->dropped > 0)
                text += print(" %lld dropped", static_cast<long long>(process.status->dropped));
        }
        if (process.restarts > 0) text += print(" %d restarts", process.restarts);
    }
    return prefix(-1) + text + '\n';
}

bool LaunchDisplay::write(const std::string& lines) {
    // One call, so that nothing of another program's stands inside a line.
    std::size_t sent = 0;
    while (!reader_gone_ && sent < lines.size()) {
        const ssize_t count = ::write(STDOUT_FILENO, lines.data() + sent, lines.size() - sent);
        if (count > 0) sent += static_cast<std::size_t>(count);
        if (count < 0 && errno != EINTR) reader_gone_ = true;
    }
    return !reader_gone_;
}

bool LaunchDisplay::show(const std::vector<LauncherEvent>& events,
                         const std::vector<ProcessReport>& processes) {
    std::string lines;
    for (const auto& event : events) lines += line_of(event);
    const bool due = !quiet_ && Clock::now() >= next_status_;
    if (lines.empty() && !due) return !reader_gone_;
    if (due) next_status_ = Clock::now() + (terminal_ ? table_interval : summary_interval);
    if (!terminal_) return write(lines + (due ? summary(processes) : ""));
    const auto height = std::count(table_.begin(), table_.end(), '\n');
    const std::string wipe = height > 0 ? print("\x1b[%dA\x1b[J", static_cast<int>(height)) : "";
    if (!quiet_) table_ = table(processes);
    return write(wipe + lines + table_);
}

void LaunchDisplay::say(const std::string& text) {
    finish({{Kind::notice, -1, text}});
}

void LaunchDisplay::finish(const std::vector<LauncherEvent>& events) {
    const auto height = std::count(table_.begin(), table_.end(), '\n');
    std::string lines = height > 0 ? print("\x1b[%dA\x1b[J", static_cast<int>(height)) : "";
    table_.clear();
    for (const auto& event : events) lines += line_of(event);
    write(lines);
}

}  // namespace goalmouth
