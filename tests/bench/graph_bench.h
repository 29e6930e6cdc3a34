#pragma once

#include "tests/bench/ratio.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace goalmouth::bench {

/// From scan-line to scan-line in the graph [px].
inline constexpr int graph_spacing = 8;

struct GraphBenchOptions {
    int width = 1600;                 // px
    int height = 1200;                // px
    double frames_per_second = 30.0;  // of the camera
    /// Of the process graph; the acceptance takes 300. What it is compared with runs for a minute at most.
    double seconds = 30.0;
    std::uint64_t seed = 1;
    /// Of the modules; empty: those of config/.
    std::filesystem::path field;
    std::filesystem::path colours;
    std::filesystem::path camera;
    bool assume_camera = false;  // no calibration: a camera 60° wide without distortion
    /// Holds the frames to send, raw 4:2:2 of the size above, in the order of their names: 000.yuyv,
    /// 001.yuyv, …
    std::filesystem::path frames_folder;
    /// Where the modules' programs are; empty: beside this program.
    std::filesystem::path programs_folder;
    /// Asked now and then; true: end early, without a result's rows.
    std::function<bool()> stop;
};

/// How old frames were when something happened to them [µs since their capture].
struct Latency {
    Latency() = default;
    explicit Latency(std::vector<double> ages);

    std::vector<double> ages;  // ascending
    /// The age that `share` (0…1) of the frames did not exceed; 0 where there are none.
    double quantile(double share) const;
    double p50() const { return quantile(0.50); }
    double p99() const { return quantile(0.99); }
    double max() const { return quantile(1.0); }
};

/// The messages of one channel, one for each frame, as the benchmark heard them.
struct StageResult {
    std::string channel;    // "POSTS"
    Latency sent;           // when the datagram left its sender (the kernel's stamp)
    Latency heard;          // when the listener had it in hand
    std::int64_t lost = 0;  // frames without it
};

/// What one process (or thread of the benchmark) took.
struct ProcessResult {
    std::string name;
    double cpu = 0.0;               // share of one core
    double memory = 0.0;            // MiB, its share of what it has in common with others (PSS)
    std::int64_t dropped = 0;       // frames left out, as its STATUS says
    std::int64_t publications = 0;  // messages it sent
};

/// One way to bring frames from the camera to posts and pose.
struct WayResult {
    std::string key;               // "graph", "one_process", "messages", "messages_large_buffer"
    std::string title;             // for people
    double seconds = 0.0;          // measured
    std::int64_t frames = 0;       // due in that time
    std::int64_t lost = 0;         // of these, without posts or without a pose
    std::int64_t not_sent = 0;     // of the lost, those the camera should have sent and did not
    int receive_buffer = 0;        // bytes the kernel granted each receiving socket; 0 where there is none
    std::string note;              // what else to know of its figures; may be empty
    double lines_left_out = -1.0;  // scan-lines of each frame that did not fit SEGMENTS; −1 = unknown
    double copies = -1.0;          // of each frame from the source to what segmentation reads; −1 = unknown
    std::vector<StageResult> stages;  // in the order of the graph
    std::vector<ProcessResult> processes;

    /// nullptr where there is none of that channel.
    const StageResult* stage(const std::string& channel) const;
    /// Of all processes, share of one core.
    double cpu() const;
};

/// What driving the process graph cost. Filled by run_graph_bench().
struct GraphBenchResult {
    bool complete = false;  // false: stopped before the end
    int width = 0;          // px
    int height = 0;         // px
    double frames_per_second = 0.0;
    int largest_receive_buffer = 0;  // net.core.rmem_max, as found
    std::vector<WayResult> ways;     // those that ran to their end
    std::string failure;             // why there are no more; empty: nothing failed

    /// nullptr where there is none of that key.
    const WayResult* way(const std::string& key) const;
    /// The rows of the acceptance table that are the graph's, those that were not measured too.
    std::vector<Ratio> ratios() const;
    nlohmann::ordered_json to_json() const;
    /// The summary a person reads.
    void print(std::ostream& out) const;
};

/// How far the run is: of `wanted` steps (seconds of graph) `done` are over; `what` names the way in hand.
using GraphBenchProgress = std::function<void(const std::string& what, double done, double wanted)>;

/// Whether it can run: the modules' programs are there, and a network namespace can be made. Cheap. Throws
/// ConfigurationError. Not from a program of several threads.
void check_graph_bench(const GraphBenchOptions& options);

/// Drives the real process graph at a camera's pace in a private network namespace, the same modules inside
/// one process, and raw pixels in LCM messages, one after the other. What fails on the way ends it and stands
/// in the result. Throws ConfigurationError for what check_graph_bench() finds.
GraphBenchResult run_graph_bench(const GraphBenchOptions& options, const GraphBenchProgress& progress);

}  // namespace goalmouth::bench
