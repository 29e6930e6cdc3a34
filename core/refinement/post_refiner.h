#pragma once

#include "core/detection/post.h"
#include "core/field/field.h"
#include "core/geometry/camera.h"
#include "core/geometry/camera_pose.h"
#include "core/imaging/yuyv.h"
#include "core/refinement/coarse_edges.h"
#include "core/refinement/goal_pairs.h"
#include "core/refinement/measured_vertical.h"
#include "core/refinement/post_colour.h"
#include "core/refinement/refined_post.h"
#include "core/refinement/refinement_parameters.h"
#include "core/refinement/silhouette_search.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// Measures posts that a detector found to a fraction of a pixel, in the frame they were found in.
///
/// For each post: its colour (post_colour.h), what the camera makes of light (camera_response.h; asked of all
/// posts of a picture together, response_evidence.h), its edges to half a pixel wherever they lie near the
/// detector's (coarse_edges.h), the rows it can be seen in (post_extent.h), the two planes that touch it
/// (silhouette_search.h), distance and bearing with covariance (refined_measurement.h).
class PostRefiner {
  public:
    PostRefiner(const RefinementParameters& parameters, const Field& field);

    /// One for each of `posts`, in their order. `pose`: where the camera was, where that is known; else it is
    /// assumed to stand about level. Valid until the next call.
    const std::vector<RefinedPost>& refine(YuyvView image, const std::vector<Post>& posts,
                                           const Intrinsics& camera, const std::optional<CameraPose>& pose);

  private:
    /// What is found out of a post before its pixels are fitted.
    struct Start {
        std::string problem;  // why there is none
        RoughOutline outline;
        PostColour colour;
        CoarseEdgeFinder::Edges edges;
    };

    Start start(YuyvView image, const Intrinsics& camera, const MeasuredVertical& vertical, const Post& post,
                CameraResponse response);
    double chroma_shift_of(YuyvView image, const Intrinsics& camera) const;      // px, by starts_
    CameraResponse response_of(YuyvView image, const Intrinsics& camera) const;  // by starts_ in levels
    /// "" where it was refined, else why not.
    std::string measure(YuyvView image, const Intrinsics& camera, const MeasuredVertical& vertical,
                        const Start& found, RefinedPost& refined);
    void use_goals(const MeasuredVertical& vertical);

    RefinementParameters parameters_;
    Field field_;
    PostColourEstimator colours_;
    CoarseEdgeFinder coarse_;
    SilhouetteSearch search_;
    std::vector<Start> starts_;
    YuyvImage moved_;  // a picture of which the chroma lay beside the luma
    std::vector<RefinedPost> refined_;
    std::vector<GoalPairPost> measured_;    // of these, which have both edges
    std::vector<std::size_t> measured_of_;  // which
};

}  // namespace goalmouth
