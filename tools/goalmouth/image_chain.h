#pragma once

#include "core/detection/post.h"
#include "core/extraction/border.h"
#include "core/extraction/candidates.h"
#include "core/geometry/camera.h"
#include "core/imaging/yuyv.h"
#include "core/localisation/belief.h"
#include "core/localisation/frame_aligner.h"
#include "core/refinement/refined_post.h"
#include "core/segmentation/segments.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace goalmouth {

/// What a graph made of one picture.
struct ImageResult {
    Intrinsics camera;  // used, at the picture's size
    Segments segments;
    FieldBorder border;
    Candidates candidates;
    /// Of all detectors of the graph, as they leave it: refined where the graph refines.
    std::vector<Post> posts;
    std::vector<std::string> detectors;  // beside `posts`: which program found it
    /// Beside `posts`: how it was measured anew, or why not; nothing where the graph does not refine it.
    std::vector<std::optional<RefinedPost>> refinements;
    std::optional<PoseEstimate> pose;            // of a chain that goes on to the pose
    std::map<std::string, double> milliseconds;  // by process
};

/// How far a chain leads.
enum class ChainEnd { posts, pose };

struct ImageChainOptions {
    std::string graph = "refined";          // file, or name of one in config/graphs/
    std::vector<std::string> settings;      // "PROCESS.KEY=VALUE"
    std::filesystem::path camera;           // "": the one of the graph, else the default C905
    std::filesystem::path field;            // "": as the graph says
    std::filesystem::path colours;          // "": as the graph says
    std::optional<Eigen::Isometry3d> T_BC;  // of all pictures, where known
    std::optional<std::uint64_t> seed;      // in place of the graph's
    ChainEnd end = ChainEnd::posts;
    bool refine = true;  // false: posts as their detector says, though the graph refines them
    /// Also what others hear without needing it, such as colours that follow the light: then what a chain
    /// says of a picture depends on those before.
    bool carry_over = false;
};

/// Whether a chain to posts has a stage that labels pixels by a colour table; `graph` as in
/// ImageChainOptions. Throws ConfigurationError as ImageChain does.
bool takes_colours(const std::string& graph);

/// One picture for the chain, with what the robot measured as it was taken. The times of `kinematics` and
/// `odometry` are replaced by the picture's.
struct ChainFrame {
    YuyvView image;
    std::int64_t seq = 0;                    // what is drawn at random for it follows from this number
    std::optional<Intrinsics> camera = {};   // of this picture, at its size; else the chain's, scaled to it
    std::optional<std::int64_t> utime = {};  // µs, later than the picture before; else a second after that
    std::optional<CameraPose> kinematics = {};  // else T_BC of the chain, where that is known
    std::optional<OdometrySample> odometry = {};
};

/// The part of a graph that leads from pictures to goalposts, or on to the robot's pose, as module objects on
/// a bus in memory: what the processes would do, in one process and without drops. What a chain says of
/// posts does not depend on the pictures before unless it carries over; the pose does, and a new chain starts
/// anew.
class ImageChain {
  public:
    /// Throws ConfigurationError, also where the graph has a stage whose program is not ours or finds no
    /// posts.
    explicit ImageChain(const ImageChainOptions& options);
    ~ImageChain();
    ImageChain(const ImageChain&) = delete;
    ImageChain& operator=(const ImageChain&) = delete;

    ImageResult run(const ChainFrame& frame);

    /// Names of the processes that take part, upstream first.
    std::vector<std::string> stages() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace goalmouth
