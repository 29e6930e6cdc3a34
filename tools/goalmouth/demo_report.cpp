#include "tools/goalmouth/demo_report.h"

#include "core/conversion/border.h"
#include "core/conversion/candidates.h"
#include "core/conversion/posts.h"
#include "core/field/field.h"
#include "core/imaging/conversion.h"
#include "tools/goalmouth/field_map.h"
#include "tools/goalmouth/output.h"
#include "tools/goalmouth/overlay.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace goalmouth {
namespace {

std::string milliseconds(double seconds) {
    return seconds < 0.0 ? "–" : fmt::format("{:.1f}", 1e3 * seconds);
}

std::int64_t dropped_frames(const std::vector<ProcessReport>& processes) {
    std::int64_t dropped = 0;
    for (const auto& process : processes) dropped += process.status ? process.status->dropped : 0;
    return dropped;
}

/// The field the graph's localisation works on; nothing in a graph without.
std::optional<Field> field_of(const Graph& graph) {
    for (const auto& process : graph.processes) {
        for (const auto& parameter : process.description.parameters) {
            if (parameter.key != "field") continue;
            const std::string file = process.configuration().file("field");
            if (!file.empty()) return load_parameters<Field>(std::filesystem::path(file));
        }
    }
    return std::nullopt;
}

cv::Mat picture_of(const SeenFrame& seen) {
    cv::Mat picture = bgr_from_yuyv(seen.image.view());
    if (seen.border) draw_border(picture, from_message(*seen.border));
    draw_posts(picture, from_message(seen.posts));
    // The edge points lie on the posts' outlines: on top, or nobody sees them.
    if (seen.candidates) draw_candidates(picture, from_message(*seen.candidates));
    return picture;
}

}  // namespace

std::string demo_table(const std::vector<ProcessReport>& processes, const DemoMonitor& monitor) {
    std::string text = fmt::format("{:<14} {:<20} {:>9} {:>9} {:>7} {:>8} {:>9} {:>8} {:>8} {:>6} {:>9}\n",
                                   "process", "program", "received", "sent", "rate/s", "dropped", "rejected",
                                   "p50 ms", "p99 ms", "core %", "restarts");
    for (const auto& process : processes) {
        text += fmt::format("{:<14} {:<20} ", process.name, process.executable);
        if (const auto& status = process.status) {
            text += fmt::format("{:>9} {:>9} {:>7.1f} {:>8} {:>9} {:>8} {:>8} {:>6.0f} {:>9}\n",
                                status->received, status->published, status->rate, status->dropped,
                                status->rejected, milliseconds(status->latency_p50),
                                milliseconds(status->latency_p99), 100.0 * status->busy, process.restarts);
        } else {
            text += fmt::format("never reported; restarts {} {}\n", process.restarts, process.last_end);
        }
    }
    text += fmt::format(
        "\nFrames through the graph: {} ({:.1f} a second); posts found: {} ({:.2f} a frame)\n",
        monitor.frames(), monitor.frames_per_second(), monitor.posts(), monitor.posts_per_frame());
    if (const auto error = monitor.median_error(judged_seconds)) {
        text +=
            fmt::format("Pose error against the truth, median of the last {:.0f} s: {:.3f} m, {:.3f} rad\n",
                        judged_seconds, error->metres, error->radians);
    }
    return text;
}

nlohmann::json demo_json(const Graph& graph, const std::vector<ProcessReport>& processes,
                         const DemoMonitor& monitor, double seconds) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& process : processes) {
        nlohmann::json entry = {{"name", process.name},
                                {"executable", process.executable},
                                {"pid", process.pid},
                                {"restarts", process.restarts},
                                {"reported", process.status.has_value()}};
        if (const auto& status = process.status) {
            entry["received"] = status->received;
            entry["published"] = status->published;
            entry["dropped"] = status->dropped;
            entry["rejected"] = status->rejected;
            entry["rate"] = status->rate;
            entry["latency_p50_s"] = status->latency_p50;
            entry["latency_p99_s"] = status->latency_p99;
            entry["busy"] = status->busy;
            for (const auto& counter : status->counters) entry["counters"][counter.name] = counter.value;
        }
        list.push_back(std::move(entry));
    }
    const auto error = monitor.median_error(judged_seconds);
    return {{"graph", graph.name},
            {"seconds", seconds},
            {"processes", list},
            {"frames", monitor.frames()},
            {"frames_per_second", monitor.frames_per_second()},
            {"posts", monitor.posts()},
            {"posts_per_frame", monitor.posts_per_frame()},
            {"pose_error_m_median", error ? nlohmann::json(error->metres) : nlohmann::json()},
            {"pose_error_rad_median", error ? nlohmann::json(error->radians) : nlohmann::json()},
            {"dropped", dropped_frames(processes)}};
}

std::vector<std::filesystem::path> write_demo_pictures(const std::filesystem::path& folder,
                                                       const Graph& graph, const DemoMonitor& monitor) {
    std::vector<std::filesystem::path> written;
    if (const auto& seen = monitor.best_frame()) {
        written.push_back(folder / "frame.png");
        write_picture(written.back(), picture_of(*seen), "--pictures");
    }
    const auto field = field_of(graph);
    if (field && !monitor.estimated_path().empty()) {
        written.push_back(folder / "field.png");
        write_picture(written.back(), field_map_of(*field, monitor), "--pictures");
    }
    return written;
}

}  // namespace goalmouth
