#include "tests/bench/frames.h"

#include "core/evaluation/cell_renderer.h"
#include "core/imaging/calibration.h"
#include "core/process/configuration.h"
#include "core/process/paths.h"
#include "tools/evaluate/paper_setup.h"
#include "tools/evaluate/parallel.h"
#include "tools/goalmouth/bench_options.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace goalmouth::bench {
namespace {

namespace fs = std::filesystem;

/// Rendering is slow; a processor's branch prediction does not remember this many frames.
constexpr int most_different = 36;  // two at each distance and tilt

std::size_t frame_bytes(ImageSize size) {
    return static_cast<std::size_t>(yuyv_row_bytes(size.width)) * static_cast<std::size_t>(size.height);
}

Intrinsics camera_for(const FrameOptions& options) {
    const fs::path file = given_or(options.camera, "--camera", "cameras/c905.yaml");
    const auto camera =
        calibration_for(load_parameters<Intrinsics>(file), options.size.width, options.size.height);
    if (!camera)
        throw ConfigurationError(
            fmt::format("--size: {}x{} has another shape than the pictures that {} is the calibration of",
                        options.size.width, options.size.height, file.string()));
    return *camera;
}

std::vector<fs::path> images_of(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (is_image_name(entry.path())) files.push_back(entry.path());
    if (error) throw ConfigurationError("--images: " + folder.string() + ": " + error.message());
    if (files.empty()) throw ConfigurationError("--images: there are no pictures in " + folder.string());
    std::sort(files.begin(), files.end());
    return files;
}

void repeat(FrameSet& set, int wanted) {
    set.different = set.frames.size();
    while (set.frames.size() < static_cast<std::size_t>(wanted))
        set.frames.push_back(set.frames[set.frames.size() - set.different]);
}

}  // namespace

fs::path given_or(const std::string& given, const char* option, const char* otherwise) {
    if (given.empty()) return config_folder() / otherwise;
    std::error_code ignored;
    if (!fs::is_regular_file(given, ignored))
        throw ConfigurationError(std::string(option) + ": there is no file " + given);
    return given;
}

std::size_t FrameSet::bytes() const {
    std::size_t sum = 0;
    for (const auto& frame : frames) sum += frame.data.size();
    return sum;
}

int frames_beyond_cache(ImageSize size, std::size_t cache) {
    return std::max(least_frames, static_cast<int>((2 * cache + frame_bytes(size) - 1) / frame_bytes(size)));
}

int different_frames(const FrameOptions& options) {
    return std::min(options.frames, most_different);
}

FrameSet render_frames(const FrameOptions& options) {
    FrameSet set;
    set.camera = camera_for(options);
    set.field = load_parameters<Field>(given_or(options.field, "--field", "fields/kidsize_2013.yaml"));
    const EvaluationScene scene = load_evaluation_scene(options.scene);
    set.source = fmt::format("scene {}, seed {}", scene.name, options.seed);
    const auto count = static_cast<std::size_t>(different_frames(options));
    set.frames.resize(count);
    set.posts.resize(count);
    set.kinematics.resize(count);
    std::vector<std::unique_ptr<CellRenderer>> renderers(static_cast<std::size_t>(options.jobs));
    for_each_in_parallel(
        count, options.jobs,
        [&](std::size_t worker, std::size_t item) {
            auto& renderer = renderers[worker];
            if (!renderer)
                renderer = std::make_unique<CellRenderer>(scene, set.field, set.camera, options.seed);
            const int number = static_cast<int>(item);
            CellFrame frame = renderer->render(number % cell_count, number / cell_count);
            set.posts[item] = frame.outlines();
            set.kinematics[item] = frame.kinematics;
            set.frames[item] = std::move(frame.image);
            if (options.step) options.step();
        },
        options.stop);
    if (options.stop && options.stop()) return set;
    repeat(set, options.frames);
    return set;
}

FrameSet read_frames(const fs::path& folder, const FrameOptions& options) {
    FrameSet set;
    for (const auto& file : images_of(folder)) {
        if (options.stop && options.stop()) return set;
        if (set.frames.size() == static_cast<std::size_t>(options.frames)) break;
        set.frames.push_back(read_image(file, options.size));
        if (options.step) options.step();
    }
    set.source = fmt::format("{} pictures of {}", set.frames.size(), folder.filename().string());
    set.field = load_parameters<Field>(given_or(options.field, "--field", "fields/kidsize_2013.yaml"));
    set.camera = options.camera.empty() ? assumed_camera(options.size.width, options.size.height)
                                        : camera_for(options);
    repeat(set, options.frames);
    return set;
}

ImageSize size_of_images(const fs::path& folder) {
    const fs::path first = images_of(folder).front();
    if (is_raw_image_name(first))
        throw ConfigurationError("--images: " + first.string() +
                                 ": raw pictures do not say their size; convert them (PNG)");
    const YuyvImage image = read_image(first);
    return {image.width, image.height};
}

void write_frames(const FrameSet& set, const fs::path& folder) {
    for (std::size_t i = 0; i < set.different; ++i)
        write_yuyv(folder / fmt::format("{:03}.yuyv", i), set.view(i));
}

}  // namespace goalmouth::bench
