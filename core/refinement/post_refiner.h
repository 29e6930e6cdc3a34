#pragma once

#include "core/detection/post.h"
#include "core/field/field.h"
#include "core/geometry/camera.h"
#include "core/geometry/camera_pose.h"
#include "core/imaging/yuyv.h"
#include "core/refinement/coarse_edges.h"
#include "core/refinement/distance_cues.h"
#include "core/refinement/goal_pairs.h"
#include "core/refinement/post_colour.h"
#include "core/refinement/refined_post.h"
#include "core/refinement/refinement_parameters.h"
#include "core/refinement/silhouette_fit.h"

#include <optional>
#include <vector>

namespace goalmouth {

/// Measures posts that a detector found to a fraction of a pixel, in the frame they were found in.
///
/// For each post: its colour (post_colour.h), its edges to half a pixel wherever they lie near the detector's
/// (coarse_edges.h), the rows it can be seen in (post_extent.h), the two planes that touch it
/// (silhouette_fit.h), distance and bearing with covariance (refined_measurement.h).
class PostRefiner {
  public:
    PostRefiner(const RefinementParameters& parameters, const Field& field);

    /// One for each of `posts`, in their order. `pose`: where the camera was, where that is known; else it is
    /// assumed to stand about level. Valid until the next call.
    const std::vector<RefinedPost>& refine(YuyvView image, const std::vector<Post>& posts,
                                           const Intrinsics& camera, const std::optional<CameraPose>& pose);

  private:
    /// The measured vertical.
    struct Vertical {
        Eigen::Vector3d up = -Eigen::Vector3d::UnitY();  // frame C
        Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
        std::optional<CameraStance> camera;
    };

    Vertical vertical(const std::optional<CameraPose>& pose) const;
    /// "" where it was refined, else why not.
    const char* refine_one(YuyvView image, const Intrinsics& camera, const Vertical& vertical,
                           RefinedPost& refined);
    void use_goals(const Vertical& vertical);

    RefinementParameters parameters_;
    Field field_;
    PostColourEstimator colours_;
    CoarseEdgeFinder coarse_;
    SilhouetteFitter fitter_;
    std::vector<RefinedPost> refined_;
    std::vector<GoalPairPost> measured_;    // of these, which have both edges
    std::vector<std::size_t> measured_of_;  // which
};

}  // namespace goalmouth
