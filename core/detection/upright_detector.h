#pragma once

#include "core/detection/edge_lines.h"
#include "core/detection/post.h"
#include "core/detection/upright_evidence.h"
#include "core/detection/upright_pairs.h"
#include "core/detection/upright_parameters.h"
#include "core/detection/upright_view.h"
#include "core/detection/upright_votes.h"
#include "core/extraction/candidates.h"
#include "core/field/field.h"
#include "core/geometry/camera.h"
#include "core/geometry/camera_pose.h"

#include <optional>
#include <vector>

namespace goalmouth {

/// Goalposts as what they are: upright, of a known diameter and height, on the ground.
///
/// The paper fits lines to left and to right edge points, each on its own, and then asks which of them are
/// alike. An edge that is hidden or stands before something of the post's colour over part of its length is
/// no longer like its partner, and every other straight thing takes one of the few lines there are. Here the
/// two edges are one hypothesis: they share the direction of the measured vertical, all but a small roll, so
/// that each is one number, an azimuth; their difference tells the distance, and distance and goal tell in
/// which rows the post has to show. So a post is found by what is seen of either edge anywhere along it.
///
///   1  For each roll that the vertical's uncertainty allows: where left, and where right edge points pile up
///      (AzimuthVotes), and which pairs of them make a post at a plausible distance with enough points
///      between its ends. No draws: the same candidates give the same posts.
///   2  The best of these are fitted to their points (least squares of left, right and roll, the vertical as
///      prior), then judged row by row (UprightJudge); what the roll leaves the measured vertical by costs.
///   3  The best of those that pass are posts, first the two that go best together, if any do (UprightPairs),
///      then one after the other, as long as they share no edge with one before and do not overlap it.
///
/// A camera that looks along the vertical sees none. Posts cut by the picture's side border are those of the
/// paper's variant (cut_posts.h), from edges that no post has taken. Distance by the angle between the planes
/// through the edges, D = r / sin η.
class UprightDetector {
  public:
    UprightDetector(const UprightDetectorParameters& parameters, const Field& field);

    /// `pose`: where the camera was, if that is known. From left to right. Valid until the next call. No heap
    /// allocation once warm.
    const std::vector<Post>& detect(const Candidates& candidates, const Intrinsics& camera,
                                    const std::optional<CameraPose>& pose);

  private:
    struct Hypothesis {
        UprightEdges edges;
        double promise = 0.0;
    };

    void suggest(const UprightView& view, double tolerance);
    /// Slopes between which a post with such edges may show, for certain.
    struct Ends {
        double top, base;
    };
    Ends ends_of(const UprightView& view, const UprightEdges& edges) const;
    double usual_rows(const UprightEdges& edges) const;
    int points_along(const UprightView& view, const UprightEdges& edges, double tolerance) const;
    /// Least squares of the points near its edges and between its ends.
    UprightEdges fitted(const UprightView& view, const UprightEdges& edges, double tolerance) const;
    bool passes(const UprightEvidence& evidence) const;
    std::optional<Post> post_of(const UprightPost& found, const UprightView& view,
                                const Intrinsics& camera) const;
    void add_cut_posts(const Candidates& candidates, const Intrinsics& camera, double tolerance);
    std::optional<EdgeLine> free_edge(const std::vector<UprightPoint>& points, bool left, double tolerance);

    UprightDetectorParameters parameters_;
    UprightSize size_;
    double narrowest_, widest_;  // rad, between the edges of a post at a plausible distance
    double roll_sigma_ = 0.0;    // rad
    double row_step_ = 1.0;      // px, from one horizontal scan-line to the next
    double view_scale_ = 1.0;    // px per unit of slope
    UprightJudge judge_;
    UprightPairs pairs_;
    AzimuthVotes votes_;
    UprightCandidates seen_;
    std::vector<AzimuthPeak> left_, right_;
    std::vector<Hypothesis> hypotheses_;
    std::vector<UprightEdges> fits_;  // that were judged
    std::vector<UprightPost> found_, taken_;
    std::vector<UprightPoint> free_;
    std::vector<Eigen::Vector2d> edge_points_;
    std::vector<Post> posts_;
};

}  // namespace goalmouth
