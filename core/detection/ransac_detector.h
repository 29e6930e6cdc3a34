#pragma once

#include "core/detection/cut_posts.h"
#include "core/detection/line_search.h"
#include "core/detection/measurement.h"
#include "core/detection/pairing.h"
#include "core/detection/post.h"
#include "core/detection/post_sides.h"
#include "core/detection/ransac_parameters.h"
#include "core/extraction/candidates.h"
#include "core/geometry/camera.h"
#include "core/random/random.h"

#include <vector>

namespace goalmouth {

struct RansacDetectorParameters {
    RansacParameters ransac;
    PairingParameters pairing;
    CutPostParameters cut_posts;
    MeasurementParameters measurement;
    PostSideParameters sides;
};

template <class Visitor>
void describe_parameters(Visitor& v, RansacDetectorParameters& p) {
    v.group("ransac", p.ransac, "lines among the edge points (Algorithm 2)");
    v.group("pairing", p.pairing, "which lines make a post");
    v.group("cut_posts", p.cut_posts, "posts that the image's border cuts");
    v.group("measurement", p.measurement, "distance, bearing and their uncertainty");
    v.group("sides", p.sides, "which post of its goal");
}

/// Goalposts by RANSAC (paper, section 4): lines among the left edge points and among the right ones, pairs
/// of lines that satisfy the rules of a post, whose four end points are its corners. Beyond the paper: posts
/// cut by the image's border, and what is measured. `diameter` of the posts [m]. From left to right.
class RansacDetector {
  public:
    RansacDetector(const RansacDetectorParameters& parameters, double diameter)
        : parameters_(parameters),
          diameter_(diameter),
          left_(parameters.ransac),
          right_(parameters.ransac),
          pairing_(parameters.pairing) {}

    /// Valid until the next call. No heap allocation once warm.
    const std::vector<Post>& detect(const Candidates& candidates, const Intrinsics& camera, Random& random);

  private:
    RansacDetectorParameters parameters_;
    double diameter_;
    LineSearch left_;
    LineSearch right_;
    EdgePairing pairing_;
    std::vector<Post> posts_;
};

/// The posts of one frame: a RansacDetector used once.
std::vector<Post> detect_posts_by_ransac(const Candidates& candidates, const Intrinsics& camera,
                                         double diameter, const RansacDetectorParameters& parameters,
                                         Random& random);

}  // namespace goalmouth
