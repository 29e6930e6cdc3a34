#pragma once

#include "core/process/launcher.h"

#include <chrono>
#include <string>
#include <vector>

namespace goalmouth {

/// What a person sees of a running graph: each line of each process under its name, what happens to
/// processes, and who is alive: on a terminal as a table that stays below the lines, elsewhere as a line now
/// and then.
class LaunchDisplay {
  public:
    /// `quiet`: only what goes wrong.
    LaunchDisplay(const Graph& graph, bool quiet);

    /// Shows the events, and how the processes stand when that is due. False once nobody reads it any more.
    bool show(const std::vector<LauncherEvent>& events, const std::vector<ProcessReport>& processes);
    /// Shows a sentence of the launcher itself.
    void say(const std::string& text);
    /// Shows the last events and takes the table away.
    void finish(const std::vector<LauncherEvent>& events);

  private:
    std::string line_of(const LauncherEvent& event) const;
    std::string prefix(int process) const;
    std::string table(const std::vector<ProcessReport>& processes) const;
    std::string summary(const std::vector<ProcessReport>& processes) const;
    bool write(const std::string& lines);

    std::vector<std::string> names_;
    std::size_t name_width_ = 0;
    bool quiet_;
    bool terminal_;
    bool colours_;
    bool reader_gone_ = false;
    std::string table_;  // as it stands on the terminal now
    std::chrono::steady_clock::time_point next_status_;
};

}  // namespace goalmouth
