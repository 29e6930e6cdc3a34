#pragma once

#include "core/evaluation/reference_post.h"
#include "core/field/field.h"
#include "core/geometry/camera.h"
#include "core/geometry/camera_pose.h"
#include "core/imaging/image_file.h"
#include "core/imaging/yuyv.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth::bench {

/// The pictures that everybody works on, in the order in which they are visited: different ones first, then
/// the same again in other memory, until there is more memory than a cache holds.
struct FrameSet {
    std::vector<YuyvImage> frames;
    std::size_t different = 0;                      // the first so many frames; frame i shows i mod different
    std::vector<std::vector<ReferencePost>> posts;  // true ones of the different frames; empty: not known
    std::vector<std::optional<CameraPose>> kinematics;  // likewise: what the robot would say
    Intrinsics camera;                                  // as detectors are told
    Field field;
    std::string source;  // for people: "scene match, seed 1"

    int width() const { return camera.width; }
    int height() const { return camera.height; }
    std::size_t bytes() const;
    YuyvView view(std::size_t i) const { return frames[i].view(); }
};

/// The file an option names, or that of config/ where it names none. Throws ConfigurationError.
std::filesystem::path given_or(const std::string& given, const char* option, const char* otherwise);

/// How many frames of a size are needed to fill twice `cache` bytes, and never fewer than least_frames.
int frames_beyond_cache(ImageSize size, std::size_t cache);

struct FrameOptions {
    ImageSize size;
    int frames = 0;
    std::string scene;
    std::string field;
    std::string camera;
    std::uint64_t seed = 1;
    int jobs = 1;                // threads that render
    std::function<bool()> stop;  // asked between frames; the set is then incomplete
    std::function<void()> step;  // after each frame
};

/// As many are rendered, the others are copies.
int different_frames(const FrameOptions& options);

/// Frames of the paper's experiment: all distances and tilts in turn. Throws ConfigurationError.
FrameSet render_frames(const FrameOptions& options);

/// The pictures of a folder, all of one size, in the order of their names. Throws ConfigurationError.
FrameSet read_frames(const std::filesystem::path& folder, const FrameOptions& options);

/// The size of the pictures in a folder. Throws ConfigurationError.
ImageSize size_of_images(const std::filesystem::path& folder);

/// The different frames as 000.yuyv, 001.yuyv, … in a folder that exists. Throws FileError.
void write_frames(const FrameSet& set, const std::filesystem::path& folder);

}  // namespace goalmouth::bench
