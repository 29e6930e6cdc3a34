#include "tests/bench/graph/process_way.h"

#include "core/imaging/calibration.h"
#include "core/messaging/clock.h"
#include "core/process/configuration.h"
#include "core/process/launcher.h"
#include "tests/bench/graph/copies.h"
#include "tests/bench/graph/frame_listener.h"
#include "tests/bench/graph/pacing.h"
#include "tests/bench/graph/raw_sender.h"
#include "tests/bench/graph/standing_robot.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace goalmouth::bench {
namespace {

constexpr std::chrono::seconds patience_with_start{30};
constexpr std::chrono::milliseconds warm_up{1500};
constexpr std::chrono::milliseconds longest_drain{1500};  // for frames in the graph as the measurement ends
constexpr std::chrono::milliseconds notice_time{100};     // for its last frames to be heard of
constexpr std::chrono::milliseconds step_time{50};

/// What the processes had taken, counted and sent up to a moment.
struct Usage {
    double cpu = 0.0;
    std::int64_t dropped = 0;
    std::int64_t published = 0;
};

/// A graph with everything around it that the measurement needs.
class Run {
  public:
    Run(const ProcessWay& way, const GraphBenchOptions& options)
        : way_(way),
          options_(options),
          file_(graph_text(options, way.pixels)),
          launcher_(load_graph(file_.path().string()), launcher_options(way)),
          listener_(way.lcm_url, journal_, way.pixels == Pixels::ring),
          robot_(way.lcm_url) {
        launcher_.start();
    }

    /// Lets things happen for a moment. Throws where a process ends.
    void step() {
        if (const std::string problem = sender_ ? sender_->failure() : ""; !problem.empty())
            throw std::runtime_error("the benchmark's graph: sender: " + problem);
        for (const LauncherEvent& event : launcher_.poll(step_time)) {
            using Kind = LauncherEvent::Kind;
            const std::string who =
                event.process < 0 ? std::string("launcher")
                                  : launcher_.graph().processes[static_cast<std::size_t>(event.process)].name;
            if (event.kind == Kind::output) story_ += who + ": " + event.text + "\n";
            if (event.kind == Kind::died || event.kind == Kind::finished || event.kind == Kind::failed) {
                throw std::runtime_error("the benchmark's graph: " + who + ": " + event.text +
                                         (story_.empty() ? "" : "\n" + story_));
            }
        }
    }

    bool everyone_has_reported() const {
        const auto processes = launcher_.processes();
        return std::all_of(processes.begin(), processes.end(),
                           [](const ProcessReport& process) { return process.status.has_value(); });
    }

    void send_raw_frames() {
        std::optional<Intrinsics> camera;
        if (!options_.assume_camera)
            camera = calibration_for(load_parameters<Intrinsics>(camera_file(options_)), options_.width,
                                     options_.height);
        sender_ =
            std::make_unique<RawSender>(way_.lcm_url, options_.frames_folder,
                                        camera.value_or(assumed_camera(options_.width, options_.height)),
                                        options_.frames_per_second, journal_);
    }

    /// By name; the benchmark's own threads included.
    std::map<std::string, Usage> usage() {
        std::map<std::string, Usage> now;
        for (const ProcessReport& process : launcher_.processes()) {
            Usage& usage = now[process.name];
            usage.cpu = process_cpu_seconds(process.pid);
            if (!process.status) continue;
            usage.dropped = process.status->dropped;
            usage.published = process.status->published;
        }
        if (sender_) now["sender"].cpu = sender_->cpu_seconds();
        return now;
    }

    /// What a process counts, by its last STATUS.
    std::map<std::string, double> counters(const std::string& name) const {
        std::map<std::string, double> counters;
        for (const ProcessReport& process : launcher_.processes()) {
            if (process.name != name || !process.status) continue;
            for (const counter_t& counter : process.status->counters) counters[counter.name] = counter.value;
        }
        return counters;
    }

    /// Scan-lines of each frame that segmentation left out, by its last STATUS.
    double lines_left_out() const {
        for (const ProcessReport& process : launcher_.processes()) {
            if (process.name == "segmentation" && process.status)
                return per_frame(counters(process.name), "lines_left_out",
                                 journal_.sent_until(Stage::segments, process.status->utime));
        }
        return -1.0;
    }

    /// Who takes part, upstream first.
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        if (sender_) names.emplace_back("sender");
        for (const GraphProcess& process : launcher_.graph().processes) names.push_back(process.name);
        return names;
    }

    /// Memory by name.
    std::map<std::string, double> memory() const {
        std::map<std::string, double> now;
        for (const ProcessReport& process : launcher_.processes())
            now[process.name] = process_memory(process.pid);
        return now;
    }

    /// −1 before the first.
    std::int64_t latest_seq(Stage stage) const {
        const auto entry = journal_.latest(stage);
        return entry ? entry->seq : -1;
    }
    const FrameJournal& journal() const { return journal_; }
    const std::string& story() const { return story_; }

  private:
    static LauncherOptions launcher_options(const ProcessWay& way) {
        LauncherOptions options;
        options.lcm_url = way.lcm_url;
        return options;
    }

    ProcessWay way_;
    GraphBenchOptions options_;
    GraphFileOnDisk file_;
    FrameJournal journal_;
    Launcher launcher_;
    FrameListener listener_;
    StandingRobotProcess robot_;
    std::unique_ptr<RawSender> sender_;
    std::string story_;
};

/// Steps until it holds. False where that took too long or the run is to end.
bool step_until(Run& run, const std::function<bool()>& holds, Clock::duration limit,
                const std::function<bool()>& keep_going) {
    const auto end = Clock::now() + limit;
    while (!holds()) {
        if (Clock::now() >= end || !keep_going()) return holds();
        run.step();
    }
    return true;
}

std::vector<ProcessResult> costs(const std::map<std::string, Usage>& before,
                                 const std::map<std::string, Usage>& after,
                                 const std::map<std::string, double>& memory,
                                 const std::vector<std::string>& names, double seconds) {
    std::vector<ProcessResult> results;
    for (const std::string& name : names) {
        ProcessResult result;
        result.name = name;
        const Usage& end = after.at(name);
        const auto start = before.find(name);
        const Usage begin = start == before.end() ? Usage{} : start->second;
        result.cpu = (end.cpu - begin.cpu) / seconds;
        result.dropped = end.dropped - begin.dropped;
        result.publications = end.published - begin.published;
        if (const auto found = memory.find(name); found != memory.end()) result.memory = found->second;
        results.push_back(std::move(result));
    }
    return results;
}

}  // namespace

std::optional<WayResult> run_processes(const ProcessWay& way, const GraphBenchOptions& options,
                                       const KeepGoing& keep_going) {
    Run run(way, options);
    double measured = 0.0;
    const auto go_on = [&] { return keep_going(measured); };
    const auto give_up = [&](const std::string& what) -> std::optional<WayResult> {
        if (!go_on()) return std::nullopt;
        throw std::runtime_error("the benchmark's graph: " + what + "\n" + run.story());
    };
    if (way.pixels == Pixels::messages) {
        if (!step_until(
                run, [&] { return run.everyone_has_reported(); }, patience_with_start, go_on))
            return give_up("not every process reported");
        run.send_raw_frames();
    }
    if (!step_until(
            run, [&] { return run.everyone_has_reported() && run.latest_seq(Stage::image) >= 0; },
            patience_with_start, go_on))
        return give_up("no frame came");
    step_until(
        run, [] { return false; }, warm_up, go_on);

    WayResult result;
    result.key = way.key;
    result.title = way.title;
    const auto before = run.usage();
    const std::int64_t begin = now_utime();
    const auto start = Clock::now();
    const auto planned =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(way.seconds));
    const auto time_is_up = [&] {
        measured = std::chrono::duration<double>(Clock::now() - start).count();
        return Clock::now() >= start + planned;
    };
    if (!step_until(run, time_is_up, planned + std::chrono::seconds(10), go_on)) return std::nullopt;
    const std::int64_t end = now_utime();
    const auto after = run.usage();
    const auto memory = run.memory();
    result.copies = copies_per_frame(run.counters("camera"));
    result.lines_left_out = run.lines_left_out();
    step_until(
        run, [] { return false; }, notice_time, go_on);
    const std::int64_t last = run.latest_seq(Stage::image);
    step_until(
        run, [&] { return run.latest_seq(Stage::pose) >= last; }, longest_drain, go_on);

    result.seconds = 1e-6 * static_cast<double>(end - begin);
    const auto summary = run.journal().summary(begin, end, options.frames_per_second);
    result.frames = summary.frames;
    result.lost = summary.lost;
    result.not_sent = summary.not_sent;
    result.stages = summary.stages;
    result.receive_buffer = way.receive_buffer;
    result.note = way.note;
    result.processes = costs(before, after, memory, run.names(), result.seconds);
    return result;
}

}  // namespace goalmouth::bench
