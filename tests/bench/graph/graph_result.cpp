#include "core/messaging/channels.h"
#include "tests/bench/graph/quantile.h"
#include "tests/bench/graph_bench.h"

#include <algorithm>
#include <fmt/format.h>
#include <ostream>
#include <utility>

#include <nlohmann/json.hpp>

namespace goalmouth::bench {
namespace {

using Json = nlohmann::ordered_json;

// Of the acceptance table.
constexpr double promised_seconds = 300.0;
constexpr double promised_rate = 30.0;  // frames per second
constexpr double stretch_rate = 60.0;

const char* const copies_note =
    "the source here is files, read straight into shared memory; tests/vm shows the same of a real driver";

const Latency none;

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
    json["not_sent"] = way.not_sent;
    if (way.receive_buffer > 0) json["receive_buffer"] = way.receive_buffer;
    if (way.copies >= 0.0) json["copies_per_frame"] = way.copies;
    if (way.lines_left_out >= 0.0) json["lines_left_out_per_frame"] = way.lines_left_out;
    if (!way.note.empty()) json["note"] = way.note;
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
    out << fmt::format("{:46}{:^25}{:^25}{:^25}{:>7}\n", "", "capture to posts [us]", "capture to pose [us]",
                       "frames without", "CPU");
    out << fmt::format("{:46} {:>7} {:>7} {:>7}  {:>7} {:>7} {:>7}  {:>7} {:>7} {:>7} {:>7}\n", "", "p50",
                       "p99", "max", "p50", "p99", "max", "posts", "pose", "of", "%");
    for (const WayResult& way : result.ways) {
        out << fmt::format("{:46} {}  {}  {:7} {:7} {:7} {:7.1f}\n", way.title,
                           microseconds(heard(way, channels::posts)),
                           microseconds(heard(way, channels::pose)), lost(way, channels::posts),
                           lost(way, channels::pose), way.frames, 100.0 * way.cpu());
    }
}

void print_stages(std::ostream& out, const GraphBenchResult& result) {
    out << "\nAge of a frame as each message is sent, p50 / p99 [us]; the last column: posts in a listener's "
           "hand\n";
    out << fmt::format("{:46}", "");
    for (const char* channel : {channels::image, channels::segments, channels::candidates, channels::posts})
        out << fmt::format("{:>16}", channel);
    out << fmt::format("{:>16}\n", "POSTS heard");
    const auto age = [](const Latency& latency) {
        return latency.ages.empty() ? std::string("-")
                                    : fmt::format("{:.0f} / {:.0f}", latency.p50(), latency.p99());
    };
    for (const WayResult& way : result.ways) {
        out << fmt::format("{:46}", way.title);
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
        std::string line = fmt::format("{:46}", way.title);
        for (const ProcessResult& process : way.processes) {
            line += fmt::format(" {} {:.1f} %", process.name, 100.0 * process.cpu);
            if (process.memory > 0.0) line += fmt::format(" {:.0f} MiB", process.memory);
            line += process.dropped > 0 ? fmt::format(" ({} dropped);", process.dropped) : ";";
        }
        line.pop_back();
        out << line << '\n';
    }
}

std::string facts(const WayResult& way) {
    std::string text = fmt::format("{:.0f} s; {} of {} frames lost", way.seconds, way.lost, way.frames);
    if (way.not_sent > 0) text += fmt::format(", {} of these never sent", way.not_sent);
    if (way.lines_left_out >= 0.0)
        text += fmt::format("; {:.1f} scan-lines of a frame left out of SEGMENTS", way.lines_left_out);
    if (way.copies >= 0.0)
        text +=
            fmt::format("; {:g} copies of a frame between its source (files) and segmentation", way.copies);
    if (way.receive_buffer > 0) text += fmt::format("; receive buffers of {} bytes", way.receive_buffer);
    if (!way.note.empty()) text += "; " + way.note;
    return text;
}

}  // namespace

Latency::Latency(std::vector<double> unordered) : ages(std::move(unordered)) {
    std::sort(ages.begin(), ages.end());
}

double Latency::quantile(double share) const {
    if (ages.empty()) return 0.0;
    return bench::quantile(ages, share);
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
    const WayResult* graph = way("graph");
    const WayResult* alone = way("one_process");
    const std::string size = fmt::format("{}x{}", width, height);

    Ratio losses;
    losses.name = fmt::format("frames lost, {}, {:g} fps, 5 processes", size, frames_per_second);
    losses.unit = "frames";
    losses.other = "frames due";
    losses.measured = graph != nullptr && graph->frames > 0;
    losses.tests_stretch = frames_per_second >= stretch_rate;
    losses.note = fmt::format("hoped for at {:g} frames per second", stretch_rate);
    if (losses.measured) {
        losses.seconds = graph->seconds;
        losses.ours_ms = static_cast<double>(graph->lost);
        losses.other_ms = static_cast<double>(graph->frames);
        losses.ratio = losses.ours_ms / losses.other_ms;
        if (graph->seconds < promised_seconds || width != 1600 || height != 1200 ||
            frames_per_second < promised_rate)
            losses.scope =
                fmt::format("for {:.0f} s at {}{}", graph->seconds, size,
                            frames_per_second < promised_rate ? fmt::format(", {:g} fps", frames_per_second)
                                                              : std::string());
    }

    const Latency& ours = graph == nullptr ? none : heard(*graph, channels::posts);
    const Latency& other = alone == nullptr ? none : heard(*alone, channels::posts);
    const bool compared = ours.p50() > 0.0 && other.p50() > 0.0;
    Ratio posts;
    posts.name = "capture-to-posts p50, process graph ÷ one process";
    posts.other = "the same modules in one process";
    posts.bar = 2.0;
    posts.stretch = 1.5;
    posts.measured = compared;
    posts.ours_ms = 1e-3 * ours.p50();
    posts.other_ms = 1e-3 * other.p50();
    if (compared) posts.ratio = ours.p50() / other.p50();
    if (compared) posts.seconds = std::min(graph->seconds, alone->seconds);

    Ratio copies;
    copies.name = "copies of a frame between driver and detector";
    copies.unit = "copies";
    copies.other = "frame";
    copies.other_ms = 1.0;
    copies.bar = 1.0;
    copies.note = copies_note;
    copies.measured = graph != nullptr && graph->copies >= 0.0;
    if (copies.measured) copies.ours_ms = copies.ratio = graph->copies;

    std::vector<Ratio> rows{losses, posts, copies};
    for (Ratio& row : rows) row.size = size;
    rows[1].spacing = graph_spacing;
    if (compared && (width != 1600 || height != 1200)) rows[1].scope = "at " + size;
    return rows;
}

nlohmann::ordered_json GraphBenchResult::to_json() const {
    Json json{{"complete", complete},
              {"width", width},
              {"height", height},
              {"frames_per_second", frames_per_second},
              {"largest_receive_buffer", largest_receive_buffer}};
    if (!failure.empty()) json["failure"] = failure;
    json["ways"] = Json::array();
    for (const WayResult& way : ways) json["ways"].push_back(bench::to_json(way));
    return json;
}

void GraphBenchResult::print(std::ostream& out) const {
    out << fmt::format("The process graph, {}x{} at {:g} frames/s", width, height, frames_per_second);
    if (!ways.empty()) out << fmt::format(", {:.0f} s", ways.front().seconds);
    out << (complete ? "" : "; stopped before its end") << "\n\n";
    if (!failure.empty()) out << "It failed: " << failure << "\n\n";
    if (ways.empty()) return;
    print_ways(out, *this);
    print_stages(out, *this);
    print_processes(out, *this);
    out << '\n';
    for (const WayResult& way : ways) {
        out << way.title << ": " << facts(way) << '\n';
    }
}

}  // namespace goalmouth::bench
