#pragma once

#include "core/detection/post.h"
#include "core/evaluation/cell_renderer.h"
#include "core/evaluation/post_matching.h"
#include "core/field/field.h"
#include "core/geometry/camera.h"
#include "core/geometry/camera_pose.h"
#include "core/imaging/yuyv.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// What a detector gets of a frame.
struct DetectorInput {
    YuyvView image;
    std::int64_t seq = 0;                    // what it draws at random follows from this number
    Intrinsics told;                         // what it may believe of the camera
    std::optional<CameraPose> kinematics;    // what the robot measured of the camera's pose
    std::optional<std::int64_t> utime = {};  // µs, later than the frame before; else a second after that
};

DetectorInput input_of(const CellFrame& frame, std::int64_t seq);

/// Finds the posts in a frame.
using DetectPosts = std::function<std::vector<Post>(const DetectorInput& input)>;

/// A detector under evaluation. `make` is called once for each thread that uses it, in turn.
struct Detector {
    std::string name;
    std::function<DetectPosts()> make;
};

/// Part `part` of `parts`, from 1: the frames whose running number ≡ part − 1 (mod parts).
struct Shard {
    int part = 1;
    int parts = 1;
    bool operator==(const Shard&) const = default;
};

/// What is run: for each scene 18 cells with so many frames each.
struct PaperGrid {
    std::vector<EvaluationScene> scenes;
    Field field;
    Intrinsics camera;  // the calibration file's, at the pictures' size
    std::uint64_t seed = 1;
    int frames_per_cell = 200;
    MatchingRule rule;
};

/// Which frame of a grid.
struct FramePlace {
    int scene = 0;  // of PaperGrid::scenes
    int cell = 0;
    int index = 0;
    auto operator<=>(const FramePlace&) const = default;
};

/// Running number of a frame: scene by scene, cell by cell. And back.
std::int64_t running_number(const FramePlace& place, int frames_per_cell);
FramePlace frame_place(std::int64_t number, int frames_per_cell);

/// What became of one post.
struct PostRecord {
    bool counts = false;
    bool found = false;                          // by the rule; it counts
    bool identified = false;                     // a detection means it
    std::optional<double> distance_error;        // m, estimate − truth, where that detection has one
    std::optional<std::array<double, 2>> edges;  // px, left and right, where found
    std::optional<double> bearing_error;         // rad, detection − truth, where found

    // Of the post in line alone.
    bool both_edges = false;           // the frame shows them (PostSight::both_edges)
    bool good = false;                 // that detection is flagged as refined and has a distance
    std::optional<double> bound = {};  // m, least σ of the distance; nothing where its edges do not tell it
    /// eᵀΣ⁻¹e/2 of e = errors of (distance, bearing) and Σ the detection's covariance, where good: 1 on
    /// average where Σ is right. At most largest_normalised_error, which also stands for a Σ that is none.
    std::optional<double> normalised_error = {};
};

inline constexpr double largest_normalised_error = 1e6;

/// What one detector made of one frame. Posts that do not count are not in the numbers.
struct DetectorRecord {
    int posts = 0;
    int detected = 0;     // of them, by the rule
    int identified = 0;   // of them
    int false_posts = 0;  // detections that are neither found nor ignored
    PostRecord in_line;
    PostRecord second;  // the other post of that goal
};

struct FrameRecord {
    FramePlace place;
    std::vector<DetectorRecord> detectors;  // beside the detectors of the run
};

/// Compares what was detected in a frame with what is in it.
DetectorRecord record_of(const CellFrame& frame, const std::vector<Post>& posts, const Intrinsics& camera,
                         const MatchingRule& rule);

struct PaperWork {
    Shard shard;
    int jobs = 1;
    std::function<bool()> stop = {};  // asked before each frame
    std::function<void()> step = {};  // called after each, by any thread
};

/// Number of frames in a shard.
std::size_t frame_count(const PaperGrid& grid, const Shard& shard);

/// The records of all frames of the shard that were done, by running number; the same whatever `jobs` is.
std::vector<FrameRecord> run_paper(const PaperGrid& grid, const std::vector<Detector>& detectors,
                                   const PaperWork& work);

}  // namespace goalmouth
