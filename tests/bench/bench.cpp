#include "tests/bench/bench.h"

#include "core/imaging/colour_table_file.h"
#include "core/process/configuration.h"
#include "tests/bench/bench_report.h"
#include "tests/bench/frames.h"
#include "tests/bench/graph_bench.h"
#include "tests/bench/others.h"
#include "tests/bench/summary.h"
#include "tools/evaluate/command_line.h"
#include "tools/evaluate/progress.h"
#include "tools/evaluate/report/figure.h"
#include "tools/evaluate/report/report_folder.h"
#include "tools/goalmouth/interrupt.h"
#include "tools/goalmouth/output.h"
#include "tools/goalmouth/temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>

namespace goalmouth::bench {
namespace {

/// Frames the graph's camera shows in turn.
constexpr int most_graph_frames = 36;

void expect_outputs(const BenchOptions& options) {
    if (!options.json.empty()) expect_writable(options.json, "--json");
    if (options.report.empty()) return;
    expect_report_folder(options.report);
    expect_gnuplot();
}

class Bench {
  public:
    explicit Bench(const BenchOptions& options)
        : options_(options),
          table_(load_colour_table(given_or(options.colours, "--colours", "colours/simulator.gmct"))) {
        if (!options.simd.empty()) restrict_simd(options.simd);
        result_.options = options;
        result_.machine = this_machine();
        CommandLine command("goalmouth bench");
        for (const auto& word : bench_arguments(options)) command.word(word);
        result_.command = command.text();
        sizes_ = options.images.empty() ? bench_sizes(options.sizes)
                                        : std::vector<ImageSize>{size_of_images(options.images)};
        for (const ImageSize size : sizes_) check_frames(size);
    }

    int run() {
        if (options_.graph()) check_graph_bench(graph_options());
        std::cout << head_text(result_) << std::flush;
        const bool done = (!options_.stages() || run_stages()) && (!options_.graph() || run_graph());
        if (!done) {
            std::cerr << "goalmouth: interrupted; nothing is written\n";
            return Interrupt::exit_code;
        }
        std::cout << ratios_text(result_.ratios()) << std::flush;
        if (!options_.json.empty()) write_text(options_.json, bench_json(result_).dump(2) + "\n", "--json");
        if (!options_.report.empty()) write_bench_report(result_, options_.report);
        if (result_.stages && !result_.stages->sound()) {
            std::cerr << "goalmouth: a fast version and its plain one disagree; the figures mean nothing\n";
            return 1;
        }
        if (result_.graph && !result_.graph->failure.empty()) {
            std::cerr << "goalmouth: the graph's part failed: " << result_.graph->failure << '\n';
            return 1;
        }
        return 0;
    }

  private:
    FrameOptions frame_options(ImageSize size, int frames) {
        FrameOptions options;
        options.size = size;
        options.frames = frames;
        options.scene = options_.scene;
        options.field = options_.field;
        options.camera = options_.camera;
        options.seed = options_.seed;
        options.jobs = result_.machine.processors;
        options.stop = [this] { return interrupt_.requested(); };
        return options;
    }

    /// Says what is wrong with scene, camera or pictures before the first minute is spent.
    void check_frames(ImageSize size) {
        FrameOptions options = frame_options(size, 1);
        options.jobs = 1;
        if (options_.images.empty())
            render_frames(options);
        else
            read_frames(options_.images, options);
    }

    FrameSet make_frames(ImageSize size, int count) {
        FrameOptions options = frame_options(size, count);
        if (!options_.images.empty()) return read_frames(options_.images, options);
        Progress progress(static_cast<std::size_t>(different_frames(options)), "frames drawn");
        options.step = [&progress] { progress.step(); };
        return render_frames(options);
    }

    StageOptions stage_options() {
        StageOptions options;
        options.repetitions = static_cast<std::size_t>(options_.repetitions);
        options.seed = options_.seed;
        options.stop = [this] { return interrupt_.requested(); };
        return options;
    }

    /// Nothing where it was stopped.
    std::optional<RefinementRow> measure_refinement(const FrameSet& frames) {
        const std::vector<FoundPost> posts = found_posts(frames, table_, options_.seed);
        RefinementOptions options;
        options.repetitions = static_cast<std::size_t>(options_.repetitions);
        options.stop = [this] { return interrupt_.requested(); };
        Progress progress(refinement_steps(frames, posts, options), "turns of refinement");
        options.step = [&progress] { progress.step(); };
        return run_refinement(frames, posts, options);
    }

    bool run_stages() {
        StagesResult& stages = result_.stages.emplace();
        if (fast_line_detector(FrameSet{}).empty())
            stages.left_out.emplace_back(
                "FastLineDetector, since OpenCV was built without its contrib module ximgproc");
        for (const ImageSize size : sizes_) {
            const int wanted = options_.frames > 0
                                   ? options_.frames
                                   : frames_beyond_cache(size, result_.machine.last_level_cache);
            const Turns turns = stage_turns(static_cast<std::size_t>(wanted));
            const FrameSet frames = make_frames(size, static_cast<int>(turns.items()));
            if (interrupt_.requested()) return false;
            if (options_.graph() && size == largest()) keep_for_graph(frames);
            StageOptions options = stage_options();
            std::optional<SizeResult> measured;
            {
                Progress progress(size_steps(turns, options), "turns");
                options.step = [&progress] { progress.step(); };
                measured = run_size(frames, table_, turns, options, stages.same_segments);
            }
            if (!measured) return false;
            measured->refinement = measure_refinement(frames);
            if (!measured->refinement) return false;
            std::cout << size_text(*measured) << refinement_text(*measured) << std::flush;
            stages.sizes.push_back(std::move(*measured));
        }
        PointOptions points;
        points.seed = options_.seed;
        points.repetitions = 4 * static_cast<std::size_t>(options_.repetitions);
        points.stop = [this] { return interrupt_.requested(); };
        {
            Progress progress(point_steps(points), "turns");
            points.step = [&progress] { progress.step(); };
            stages.points = run_point_sets(points);
        }
        if (stages.points.empty()) return false;
        std::cout << left_out_text(stages) << points_text(stages.points) << std::flush;
        stages.complete = true;
        return true;
    }

    /// The size whose ratios count.
    ImageSize largest() const {
        return *std::max_element(sizes_.begin(), sizes_.end(), [](ImageSize a, ImageSize b) {
            return a.width * a.height < b.width * b.height;
        });
    }

    void keep_for_graph(const FrameSet& frames) { write_frames(frames, graph_frames_.emplace().path()); }

    GraphBenchOptions graph_options() {
        const ImageSize size = largest();
        GraphBenchOptions options;
        options.width = size.width;
        options.height = size.height;
        options.frames_per_second = options_.frames_per_second;
        options.seconds = options_.seconds;
        options.seed = options_.seed;
        options.field = options_.field;
        options.colours = options_.colours;
        options.camera = options_.camera;
        // As the stages take it, of which read_frames() knows.
        options.assume_camera = !options_.images.empty() && options_.camera.empty();
        options.stop = [this] { return interrupt_.requested(); };
        return options;
    }

    bool run_graph() {
        const ImageSize size = largest();
        if (!graph_frames_) {
            const int count =
                options_.frames > 0 ? std::min(options_.frames, most_graph_frames) : most_graph_frames;
            const FrameSet frames = make_frames(size, count);
            if (interrupt_.requested()) return false;
            keep_for_graph(frames);
        }
        GraphBenchOptions options = graph_options();
        options.frames_folder = graph_frames_->path();
        try {
            std::unique_ptr<Progress> progress;
            std::size_t shown = 0;
            result_.graph = run_graph_bench(options, [&](const std::string&, double done, double wanted) {
                if (!progress)
                    progress = std::make_unique<Progress>(static_cast<std::size_t>(std::ceil(wanted)),
                                                          "seconds of graph");
                const auto now = static_cast<std::size_t>(done);
                if (now > shown) progress->step(now - std::exchange(shown, now));
            });
        } catch (const std::exception& error) {  // the stages' figures are still good
            GraphBenchResult& failed = result_.graph.emplace();
            failed.width = size.width;
            failed.height = size.height;
            failed.frames_per_second = options_.frames_per_second;
            failed.failure = error.what();
        }
        if (interrupt_.requested()) return false;
        result_.graph->print(std::cout);
        return true;
    }

    BenchOptions options_;
    Interrupt interrupt_;
    ColourTable table_;
    std::vector<ImageSize> sizes_;
    std::optional<TemporaryFolder> graph_frames_;  // of the largest size, once there are any
    BenchResult result_;
};

}  // namespace

int run_bench(const BenchOptions& options) {
    cv::setNumThreads(1);  // first: a thread of OpenCV's would be in the way of a network namespace
    check_bench_options(options);
    expect_outputs(options);
    return Bench(options).run();
}

}  // namespace goalmouth::bench
