#pragma once

#include "core/process/launcher.h"
#include "tools/goalmouth/demo_monitor.h"

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace goalmouth {

/// Errors are judged over this last part of a run [s]: the filter has had time to settle.
inline constexpr double judged_seconds = 10.0;

/// The table at the end of a demonstration: each process, then what the graph achieved.
std::string demo_table(const std::vector<ProcessReport>& processes, const DemoMonitor& monitor);

/// The same for programs: processes, frames, frames_per_second, posts_per_frame, pose_error_m_median,
/// pose_error_rad_median (null without truth), dropped, graph, seconds.
nlohmann::json demo_json(const Graph& graph, const std::vector<ProcessReport>& processes,
                         const DemoMonitor& monitor, double seconds);

/// Writes frame.png (a camera frame with border, candidates, posts and distances) and, where there is a field
/// to draw, field.png (true and estimated path) into `folder`; returns those written. The folder exists.
/// Throws ConfigurationError where a file cannot be written.
std::vector<std::filesystem::path> write_demo_pictures(const std::filesystem::path& folder,
                                                       const Graph& graph, const DemoMonitor& monitor);

}  // namespace goalmouth
