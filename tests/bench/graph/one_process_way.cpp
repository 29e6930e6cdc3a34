#include "tests/bench/graph/one_process_way.h"

#include "core/messaging/channels.h"
#include "core/messaging/clock.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/graph.h"
#include "core/process/run_module.h"
#include "modules/camera/camera_module.h"
#include "modules/detection_ransac/detection_ransac_module.h"
#include "modules/extraction/extraction_module.h"
#include "modules/localisation/localisation_module.h"
#include "modules/segmentation/segmentation_module.h"
#include "tests/bench/graph/copies.h"
#include "tests/bench/graph/frame_journal.h"
#include "tests/bench/graph/pacing.h"
#include "tests/bench/graph/standing_robot.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <sys/prctl.h>
#include <unistd.h>
#include <utility>

namespace goalmouth::bench {
namespace {

constexpr std::chrono::milliseconds warm_up{1500};
constexpr std::chrono::milliseconds drain{100};  // the last frames' poses wait for the robot's next word
constexpr std::chrono::milliseconds longest_sleep{100};
constexpr std::chrono::seconds status_interval{1};  // as a process of its own reports

const std::vector<ModuleType>& types() {
    static const std::vector<ModuleType> list{
        module_type<CameraModule>(), module_type<SegmentationModule>(), module_type<ExtractionModule>(),
        module_type<RansacDetectionModule>(), module_type<LocalisationModule>()};
    return list;
}

const ModuleType* find_type(const std::string& executable) {
    const auto found = std::find_if(types().begin(), types().end(), [&](const ModuleType& type) {
        return type.info.executable == executable;
    });
    return found == types().end() ? nullptr : &*found;
}

Graph graph_of(const GraphBenchOptions& options) {
    GraphBenchOptions here = options;
    here.programs_folder.clear();
    GraphOptions graph_options;
    graph_options.describe = [](const std::string& executable, ProgramDescription& description) {
        const ModuleType* type = find_type(executable);
        if (type != nullptr) description = {type->info, type->parameters};
        return type != nullptr;
    };
    const GraphFileOnDisk file(graph_text(here, Pixels::ring));
    return load_graph(file.path().string(), graph_options);
}

/// The modules, the robot and the listener on one hub.
class OneProcess {
  public:
    explicit OneProcess(const Graph& graph) {
        // First, so that it hears posts when localisation does and not when that is done with them.
        listen();
        for (const GraphProcess& process : graph.processes) {
            auto part = std::make_unique<Part>();
            part->name = process.name;
            part->executable = process.executable;
            part->bus = &hub_.endpoint(process.name);
            part->context = std::make_unique<ModuleContext>(
                ModuleContext{*part->bus, part->status, process.name, graph.seed, process.channels});
            part->module = find_type(process.executable)->create(*part->context, process.configuration());
            parts_.push_back(std::move(part));
        }
        next_report_ = Clock::now() + status_interval;
    }

    /// What the main loops of the processes do, one after the other.
    void step() {
        auto wake = std::min(Clock::now() + Clock::duration(longest_sleep), next_report_);
        for (const auto& part : parts_) {
            wake = std::min(wake, Clock::now() + part->module->tick());
            hub_.run_until_idle();
        }
        sleep_until(std::min(wake, robot_.due()));
        robot_.speak(hub_.endpoint("robot"));
        hub_.run_until_idle();
        if (Clock::now() < next_report_) return;
        for (const auto& part : parts_)
            part->status.report(*part->bus, channels::status, part->name, part->executable,
                                status_t::RUNNING);
        hub_.run_until_idle();
        next_report_ += status_interval;
    }

    const FrameJournal& journal() const { return journal_; }
    std::int64_t dropped() const {
        std::int64_t dropped = 0;
        for (const auto& part : parts_) dropped += part->status.dropped_frames();
        return dropped;
    }
    std::int64_t published() const {
        std::int64_t published = 0;
        for (const auto& part : parts_) published += part->bus->counters().published;
        return published;
    }
    std::map<std::string, double> counters(const std::string& name) const {
        for (const auto& part : parts_)
            if (part->name == name) return part->status.counters();
        return {};
    }

  private:
    struct Part {
        std::string name;
        std::string executable;
        MemoryBus* bus = nullptr;
        Status status;
        std::unique_ptr<ModuleContext> context;
        std::unique_ptr<Module> module;
    };

    void listen() {
        for (std::size_t i = 0; i < stage_count; ++i) {
            hub_.endpoint("listener")
                .subscribe(stage_channels[i], Delivery::every,
                           [this, stage = static_cast<Stage>(i)](std::span<const std::uint8_t> message) {
                               const std::int64_t now = now_utime();
                               journal_.note_message(stage, message, now, now);
                           });
        }
    }

    FrameJournal journal_;
    StandingRobot robot_;
    MemoryHub hub_;
    std::vector<std::unique_ptr<Part>> parts_;
    Clock::time_point next_report_;
};

}  // namespace

std::optional<WayResult> run_in_one_process(double seconds, const GraphBenchOptions& options,
                                            const KeepGoing& keep_going) {
    ::prctl(PR_SET_TIMERSLACK, 1UL);  // as a module's program does
    OneProcess run(graph_of(options));
    double passed = 0.0;  // of what is measured
    const auto run_for = [&](Clock::duration time, bool measured) {
        const auto start = Clock::now();
        while (Clock::now() < start + time) {
            run.step();
            if (measured) passed = std::chrono::duration<double>(Clock::now() - start).count();
            if (!keep_going(passed)) return false;
        }
        return true;
    };
    if (!run_for(warm_up, false)) return std::nullopt;

    ProcessResult cost;
    cost.name = "all";
    cost.dropped = -run.dropped();
    cost.publications = -run.published();
    cost.cpu = -own_cpu_seconds();
    const std::int64_t begin = now_utime();
    const auto planned = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    if (!run_for(planned, true)) return std::nullopt;
    const std::int64_t end = now_utime();

    WayResult result;
    result.key = "one_process";
    result.title = "the same modules in one process";
    result.note = "its CPU includes the standing robot and the listener";
    result.seconds = 1e-6 * static_cast<double>(end - begin);
    cost.cpu = (cost.cpu + own_cpu_seconds()) / result.seconds;
    cost.dropped += run.dropped();
    cost.publications += run.published();
    cost.memory = process_memory(::getpid());
    result.processes.push_back(std::move(cost));
    if (!run_for(drain, false)) return std::nullopt;
    const auto summary = run.journal().summary(begin, end, options.frames_per_second);
    result.frames = summary.frames;
    result.lost = summary.lost;
    result.not_sent = summary.not_sent;
    result.stages = summary.stages;
    result.copies = copies_per_frame(run.counters("camera"));
    result.lines_left_out = per_frame(run.counters("segmentation"), "lines_left_out",
                                      run.journal().sent_until(Stage::segments, now_utime()));
    return result;
}

}  // namespace goalmouth::bench
