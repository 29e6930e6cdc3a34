#pragma once

#include "core/detection/measurement.h"
#include "core/detection/post.h"
#include "core/detection/post_sides.h"
#include "core/extraction/candidates.h"
#include "core/geometry/camera.h"

#include <vector>

namespace goalmouth {

struct HistogramParameters {
    int bins = 20;
    double peak_threshold = 150.0;
    double length_limit = 1.0;
    double edge_sigma = 2.0;
    MeasurementParameters measurement;
    PostSideParameters sides;
};

template <class Visitor>
void describe_parameters(Visitor& v, HistogramParameters& p) {
    v("bins", p.bins, Range{1, 16384}, "1", "bins of equal width (N)");
    v("peak_threshold", p.peak_threshold, above(0), "px",
      "summed segment length that makes a bin a peak (γ), for a picture of 640×480; grows with the picture's "
      "area (the paper gives no value)");
    v("length_limit", p.length_limit, at_least(0), "1",
      "segments longer than this many standard deviations of all lengths are left out (the paper gives no "
      "value); 0: none");
    v("edge_sigma", p.edge_sigma, at_least(0), "px",
      "σ of a side of the bounding box, which is an extreme of many segments");
    v.group("measurement", p.measurement, "distance, bearing and their uncertainty");
    v.group("sides", p.sides, "which post of its goal");
}

/// Goalposts by the 1-dimensional histogram (paper, section 3): lengths of the post-coloured segments of both
/// orientations summed over bins of columns, adjacent peaks merged (histogram.h), and as post the bounding
/// box of a group's segments, upright whatever the post's lean. A box that touches the image's left or right
/// border has that edge missing. `diameter` of the posts [m]. From left to right.
class HistogramDetector {
  public:
    HistogramDetector(const HistogramParameters& parameters, double diameter)
        : parameters_(parameters), diameter_(diameter) {}

    /// Valid until the next call.
    const std::vector<Post>& detect(const Candidates& candidates, const Intrinsics& camera);

  private:
    HistogramParameters parameters_;
    double diameter_;
    std::vector<Post> posts_;
};

/// The posts of one frame: a HistogramDetector used once.
std::vector<Post> detect_posts_by_histogram(const Candidates& candidates, const Intrinsics& camera,
                                            double diameter, const HistogramParameters& parameters);

}  // namespace goalmouth
