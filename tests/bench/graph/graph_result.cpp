#include "core/messaging/channels.h"
#include "tests/bench/graph_bench.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <ostream>
#include <utility>

namespace goalmouth::bench {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Latency& latency) {
    Json json{{"frames", latency.ages.size()},
              {"p50", latency.p50()},
              {"p99", latency.p99()},
              {"max", latency.max()}};
    for (int percent = 0; percent <= 100; ++percent)
        json["percentiles"].push_back(latency.quantile(0.01 * percent));
    return json;
}

Json to_json(const WayResult& way) {
    Json json{{"key", way.key},       {"title", way.title}, {"seconds", way.seconds},
              {"frames", way.frames}, {"lost", way.lost},   {"cpu", way.cpu()}};
    if (way.receive_buffer > 0) json["receive_buffer"] = way.receive_buffer;
    if (way.copies >= 0.0) json["copies_per_frame"] = way.copies;
    for (const StageResult& stage : way.stages) {
        json["stages"].push_back({{"channel", stage.channel},
                                  {"lost", stage.lost},
                                  {"sent_us", to_json(stage.sent)},
                                  {"heard_us", to_json(stage.heard)}});
    }
    for (const ProcessResult& process : way.processes) {
        json["processes"].push_back({{"name", process.name},
                                     {"cpu", process.cpu},
                                     {"memory_mib", process.memory},
                                     {"dropped", process.dropped},
                                     {"published", process.publications}});
    }
    return json;
}

const Latency& heard(const WayResult& way, const std::string& channel) {
    static const Latency none;
    const StageResult* stage = way.stage(channel);
    return stage == nullptr ? none : stage->heard;
}

std::int64_t lost(const WayResult& way, const std::string& channel) {
    const StageResult* stage = way.stage(channel);
    return stage == nullptr ? way.frames : stage->lost;
}

std::string microseconds(const Latency& latency) {
    if (latency.ages.empty()) return fmt::format("{:>7} {:>7} {:>7}", "-", "-", "-");
    return fmt::format("{:7.0f} {:7.0f} {:7.0f}", latency.p50(), latency.p99(), latency.max());
}

void print_ways(std::ostream& out, const GraphBenchResult& result) {
    out << fmt::format("{:38}{:^25}{:^25}{:^25}{:>7}\n", "", "capture to posts [us]", "capture to pose [us]",
                       "frames lost", "CPU");
    out << fmt::format("{:38} {:>7} {:>7} {:>7}  {:>7} {:>7} {:>7}  {:>7} {:>7} {:>7} {:>7}\n", "", "p50",
                       "p99", "max", "p50", "p99", "max", "posts", "pose", "of", "%");
    for (const WayResult& way : result.ways) {
        out << fmt::format("{:38} {}  {}  {:7} {:7} {:7} {:7.1f}\n", way.title,
                           microseconds(heard(way, channels::posts)),
                           microseconds(heard(way, channels::pose)), lost(way, channels::posts),
                           lost(way, channels::pose), way.frames, 100.0 * way.cpu());
    }
}

void print_stages(std::ostream& out, const GraphBenchResult& result) {
    out << "\nAge of a frame as each message is sent, p50 / p99 [us]; the last column: posts in a listener's "
           "hand\n";
    out << fmt::format("{:38}", "");
    for (const char* channel : {channels::image, channels::segments, channels::candidates, channels::posts})
        out << fmt::format("{:>16}", channel);
    out << fmt::format("{:>16}\n", "POSTS heard");
    const auto age = [](const Latency& latency) {
        return latency.ages.empty() ? std::string("-")
                                    : fmt::format("{:.0f} / {:.0f}", latency.p50(), latency.p99());
    };
    for (const WayResult& way : result.ways) {
        out << fmt::format("{:38}", way.title);
        for (const char* channel :
             {channels::image, channels::segments, channels::candidates, channels::posts}) {
            const StageResult* stage = way.stage(channel);
            out << fmt::format("{:>16}", stage == nullptr ? "-" : age(stage->sent));
        }
        out << fmt::format("{:>16}\n", age(heard(way, channels::posts)));
    }
}

void print_processes(std::ostream& out, const GraphBenchResult& result) {
    out << "\nCPU [% of a core] and memory [MiB] of each process\n";
    for (const WayResult& way : result.ways) {
        std::string line = fmt::format("{:38}", way.title);
        for (const ProcessResult& process : way.processes) {
            line += fmt::format(" {} {:.1f} %", process.name, 100.0 * process.cpu);
            if (process.memory > 0.0) line += fmt::format(" {:.0f} MiB", process.memory);
            line += process.dropped > 0 ? fmt::format(" ({} dropped);", process.dropped) : ";";
        }
        line.pop_back();
        out << line << '\n';
    }
}

}  // namespace

Latency::Latency(std::vector<double> unordered) : ages(std::move(unordered)) {
    std::sort(ages.begin(), ages.end());
}

double Latency::quantile(double share) const {
    if (ages.empty()) return 0.0;
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(ages.size())));
    return ages[std::clamp<std::size_t>(rank, 1, ages.size()) - 1];
}

const StageResult* WayResult::stage(const std::string& channel) const {
    const auto found = std::find_if(stages.begin(), stages.end(),
                                    [&](const StageResult& stage) { return stage.channel == channel; });
    return found == stages.end() ? nullptr : &*found;
}

double WayResult::cpu() const {
    double sum = 0.0;
    for (const ProcessResult& process : processes) sum += process.cpu;
    return sum;
}

const WayResult* GraphBenchResult::way(const std::string& key) const {
    const auto found =
        std::find_if(ways.begin(), ways.end(), [&](const WayResult& way) { return way.key == key; });
    return found == ways.end() ? nullptr : &*found;
}

std::vector<Ratio> GraphBenchResult::ratios() const {
    std::vector<Ratio> rows;
    const WayResult* graph = way("graph");
    if (graph == nullptr || graph->frames == 0) return rows;

    Ratio losses;
    losses.name = fmt::format("frames lost, {}x{}, {:g} fps, {:.0f} s", width, height, frames_per_second,
                              graph->seconds);
    losses.unit = "frames";
    losses.ours_ms = static_cast<double>(graph->lost);
    losses.other = "frames captured";
    losses.other_ms = static_cast<double>(graph->frames);
    losses.ratio = losses.ours_ms / losses.other_ms;
    rows.push_back(losses);

    if (const WayResult* alone = way("one_process");
        alone != nullptr && heard(*alone, channels::posts).p50() > 0.0) {
        const double ours = 1e-3 * heard(*graph, channels::posts).p50();
        const double other = 1e-3 * heard(*alone, channels::posts).p50();
        rows.push_back(
            {"capture to posts, p50, process graph", ours, alone->title, other, ours / other, 2.0, 1.5});
    }
    if (graph->copies >= 0.0) {
        Ratio copies;
        copies.name = "copies of a frame between driver and detector";
        copies.unit = "copies";
        copies.ours_ms = copies.ratio = graph->copies;
        copies.other = "frame";
        copies.other_ms = 1.0;
        copies.bar = 1.0;
        rows.push_back(copies);
    }
    return rows;
}

nlohmann::ordered_json GraphBenchResult::to_json() const {
    Json json{{"complete", complete},
              {"width", width},
              {"height", height},
              {"frames_per_second", frames_per_second},
              {"largest_receive_buffer", largest_receive_buffer}};
    json["ways"] = Json::array();
    for (const WayResult& way : ways) json["ways"].push_back(bench::to_json(way));
    return json;
}

void GraphBenchResult::print(std::ostream& out) const {
    out << fmt::format("The process graph, {}x{} at {:g} frames/s", width, height, frames_per_second);
    if (!ways.empty()) out << fmt::format(", {:.0f} s", ways.front().seconds);
    out << (complete ? "" : "; stopped before its end") << "\n\n";
    if (ways.empty()) return;
    print_ways(out, *this);
    print_stages(out, *this);
    print_processes(out, *this);
    out << '\n';
    for (const WayResult& way : ways) {
        if (way.receive_buffer > 0)
            out << fmt::format("{}: receive buffers of {} bytes\n", way.title, way.receive_buffer);
    }
    if (const WayResult* graph = way("graph"); graph != nullptr && graph->copies >= 0.0) {
        out << fmt::format("{}: {:g} copies of a frame between its source (files) and segmentation\n",
                           graph->title, graph->copies);
    }
}

}  // namespace goalmouth::bench
