#pragma once

#include "core/detection/post.h"
#include "core/extraction/border.h"
#include "core/extraction/candidates.h"
#include "core/geometry/camera.h"
#include "core/imaging/yuyv.h"
#include "core/process/graph.h"

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
    FieldBorder border;
    Candidates candidates;
    std::vector<Post> posts;                     // of all detectors of the graph
    std::vector<std::string> detectors;          // beside `posts`: which program found it
    std::map<std::string, double> milliseconds;  // by process
};

struct ImageChainOptions {
    std::string graph = "ransac";           // file, or name of one in config/graphs/
    std::vector<std::string> settings;      // "PROCESS.KEY=VALUE"
    std::filesystem::path camera;           // "": the one of the graph, else the default C905
    std::filesystem::path field;            // "": as the graph says
    std::filesystem::path colours;          // "": as the graph says
    std::optional<Eigen::Isometry3d> T_BC;  // of all pictures, where known
};

/// One picture for the chain.
struct ChainFrame {
    YuyvView image;
    std::int64_t seq = 0;              // what is drawn at random for it follows from this number
    std::optional<Intrinsics> camera;  // of this picture, at its size; else the chain's, scaled to it
};

/// The part of a graph that leads from pictures to goalposts, as module objects on a bus in memory: what the
/// processes would do, in one process and without drops. Each picture is a frame of its own, so that
/// its result does not depend on the pictures before.
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
