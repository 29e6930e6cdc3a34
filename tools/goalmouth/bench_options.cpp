#include "tools/goalmouth/bench_options.h"

#include "core/process/configuration.h"
#include "core/process/text.h"
#include "tools/goalmouth/checks.h"

#include <algorithm>
#include <fmt/format.h>

#include <CLI/CLI.hpp>

namespace goalmouth {
namespace {

constexpr int smallest_side = 64;  // px
constexpr int largest_side = 8192;
constexpr int most_frames = 100000;

/// CLI11 takes −1 for the largest number there is.
CLI::Validator seed_number() {
    return {[](std::string& text) {
                const bool digits =
                    !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
                return digits ? std::string() : "'" + text + "' is no whole number from 0";
            },
            ""};
}

}  // namespace

void add_bench_options(CLI::App& app, BenchOptions& options) {
    app.add_option("--json", options.json, "write every figure there")->type_name("FILE");
    app.add_option("--report", options.report,
                   "folder for index.html with tables and figures (SVG and PNG too)")
        ->type_name("DIR");
    app.add_option("--only", options.only,
                   "stages: the stages in one thread; graph: the processes at a camera's pace; else both")
        ->check(CLI::IsMember({"stages", "graph"}));
    app.add_option("--size", options.sizes,
                   "WIDTHxHEIGHT [px], with commas between; the ratios are those of the largest")
        ->type_name("SIZES")
        ->capture_default_str();
    app.add_option(
           "--frames", options.frames,
           fmt::format("frames of memory at each size; else {}, and more where those are not twice the "
                       "last-level cache",
                       least_frames))
        ->check(CLI::Range(1, most_frames).description(""));
    app.add_option("--images", options.images,
                   "pictures to work on in place of rendered frames, at their own size")
        ->type_name("DIR");
    app.add_option("--scene", options.scene, "flat, lit, clutter, match (config/evaluation) or a file")
        ->type_name("SCENE")
        ->capture_default_str();
    app.add_option("--field", options.field, "field description; else config/fields/kidsize_2013.yaml")
        ->type_name("FILE");
    app.add_option("--camera", options.camera,
                   "calibration, scaled to the size; else config/cameras/c905.yaml")
        ->type_name("FILE");
    app.add_option("--colours", options.colours, "colour table; else config/colours/simulator.gmct")
        ->type_name("FILE");
    app.add_option("--repetitions", options.repetitions, "how often each measures every frame")
        ->check(CLI::Range(1, 1000).description(""))
        ->capture_default_str();
    app.add_option("--simd", options.simd,
                   "with --only stages: our code as on a processor with no more than this, e.g. AVX2, SSE4, "
                   "SSSE3")
        ->type_name("NAME");
    app.add_option(
           "--seconds", options.seconds,
           "of the process graph [s], the acceptance takes 300; of what it is compared with the same, but "
           "60 at most")
        ->check(positive_number())
        ->type_name("S")
        ->capture_default_str();
    app.add_option("--fps", options.frames_per_second, "of the camera in the graph [1/s]")
        ->check(positive_number())
        ->type_name("F")
        ->capture_default_str();
    app.add_option("--seed", options.seed, "everything random follows from it")
        ->check(seed_number())
        ->capture_default_str();
    app.footer(
        "Stages: ours and what people would use instead take turns on the same frames, a few at a time, in\n"
        "one thread; Google Benchmark runs them. 36 frames are rendered at each size and laid into memory\n"
        "again and again until there is more of it than caches hold; all are read in the same order.\n"
        "docs/benchmark.md says what each contender is. Let the machine rest meanwhile.\n\n"
        "A summary goes to standard output, progress to standard error.\n\n"
        "Examples:\n"
        "  goalmouth bench --json bench.json --report bench\n"
        "  goalmouth bench --only stages --images photographs --colours hall.gmct\n"
        "  goalmouth bench --only graph --size 1600x1200 --seconds 300\n\n"
        "Exit code: 0 measured, whether promises are met or not; 1 something failed, or two versions of\n"
        "the same disagreed; 2 the command line or a file is wrong, or the graph cannot have\n"
        "a network of its own; 130 interrupted.");
}

std::vector<ImageSize> bench_sizes(const std::string& list) {
    std::vector<ImageSize> sizes;
    for (const std::string& text : split(list, ',')) {
        const auto size = parse_image_size(text);
        if (!size) throw ConfigurationError("--size: \"" + text + "\" is no size such as 640x480");
        if (std::min(size->width, size->height) < smallest_side ||
            std::max(size->width, size->height) > largest_side)
            throw ConfigurationError(
                fmt::format("--size: {}: each side must be {}…{} px", text, smallest_side, largest_side));
        if (std::find(sizes.begin(), sizes.end(), *size) != sizes.end())
            throw ConfigurationError("--size: " + text + " is named twice");
        sizes.push_back(*size);
    }
    if (sizes.empty()) throw ConfigurationError("--size: \"\" is no size such as 640x480");
    return sizes;
}

void check_bench_options(const BenchOptions& options) {
    bench_sizes(options.sizes);
    if (!options.simd.empty() && options.graph())
        throw ConfigurationError(
            "--simd: restricts the stages alone, not the graph's processes; give --only stages with it");
    if (options.images.empty()) return;
    const BenchOptions defaults;
    if (options.sizes != defaults.sizes)
        throw ConfigurationError("--size: pictures (--images) keep the size they have");
    if (options.scene != defaults.scene) throw ConfigurationError("--scene: give either it or --images");
}

std::vector<std::string> bench_arguments(const BenchOptions& options) {
    const BenchOptions defaults;
    std::vector<std::string> words;
    const auto add = [&words](const char* name, const auto& value, const auto& otherwise) {
        if (value == otherwise) return;
        words.emplace_back(name);
        words.push_back(fmt::format("{}", value));
    };
    add("--only", options.only, defaults.only);
    add("--size", options.sizes, defaults.sizes);
    add("--frames", options.frames, defaults.frames);
    add("--images", options.images, defaults.images);
    add("--scene", options.scene, defaults.scene);
    add("--field", options.field, defaults.field);
    add("--camera", options.camera, defaults.camera);
    add("--colours", options.colours, defaults.colours);
    add("--repetitions", options.repetitions, defaults.repetitions);
    add("--simd", options.simd, defaults.simd);
    add("--seconds", options.seconds, defaults.seconds);
    add("--fps", options.frames_per_second, defaults.frames_per_second);
    add("--seed", options.seed, defaults.seed);
    add("--json", options.json, defaults.json);
    add("--report", options.report, defaults.report);
    return words;
}

}  // namespace goalmouth
