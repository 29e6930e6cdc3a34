#include "tests/bench/graph_bench.h"

#include "core/messaging/message_size.h"
#include "core/process/graph.h"
#include "core/process/launcher.h"
#include "tests/bench/graph/one_process_way.h"
#include "tests/bench/graph/process_way.h"

#include <algorithm>
#include <utility>

namespace goalmouth::bench {
namespace {

constexpr double most_seconds_to_compare = 60.0;
constexpr int enough_buffer = 32 << 20;  // bytes: eight frames of two megapixels

/// Seconds of all ways together.
class ProgressSum {
  public:
    ProgressSum(const GraphBenchOptions& options, const GraphBenchProgress& progress, double wanted)
        : options_(options), progress_(progress), wanted_(wanted) {}

    /// For the way that begins now.
    KeepGoing way(const std::string& what, double seconds) {
        done_ = std::exchange(next_, next_ + seconds);
        return [this, what, seconds](double passed) {
            if (progress_) progress_(what, done_ + std::min(passed, seconds), wanted_);
            return !options_.stop || !options_.stop();
        };
    }

  private:
    const GraphBenchOptions& options_;
    const GraphBenchProgress& progress_;
    double wanted_;
    double done_ = 0.0;
    double next_ = 0.0;
};

}  // namespace

GraphBenchResult run_graph_bench(const GraphBenchOptions& options, const GraphBenchProgress& progress) {
    const std::string url = default_lcm_url;
    provide_network(url, NetworkChoice::separate);

    GraphBenchResult result;
    result.width = options.width;
    result.height = options.height;
    result.frames_per_second = options.frames_per_second;
    result.largest_receive_buffer = static_cast<int>(receive_buffers().largest / 2);

    const int large_buffer = std::min(result.largest_receive_buffer, enough_buffer);
    const std::string large_url = url + "&recv_buf_size=" + std::to_string(large_buffer);

    const double compared = std::min(options.seconds, most_seconds_to_compare);
    const std::vector<ProcessWay> ways{
        {"graph", "5 processes, frames in shared memory", Pixels::ring, url, options.seconds},
        {"messages", "frames in LCM messages, stock buffer", Pixels::messages, url, compared},
        {"messages_large_buffer", "frames in LCM messages, larger buffer", Pixels::messages, large_url,
         compared}};
    ProgressSum sum(options, progress, options.seconds + 3 * compared);
    const auto keep = [&](std::optional<WayResult> way) {
        if (way) result.ways.push_back(std::move(*way));
        return way.has_value();
    };
    const auto run = [&](const ProcessWay& way) {
        return keep(run_processes(way, options, sum.way(way.title, way.seconds)));
    };
    const auto run_alone = [&] {
        return keep(
            run_in_one_process(compared, options, sum.way("the same modules in one process", compared)));
    };
    result.complete = run(ways[0]) && run_alone() && run(ways[1]) && run(ways[2]);
    return result;
}

}  // namespace goalmouth::bench
