#pragma once

#include "core/parameters/parameters.h"

#include <cstddef>

namespace goalmouth {

/// Parameters of Algorithm 2 with the paper's values; `confidence` is ours.
struct RansacParameters {
    int attempts = 50;
    int minimum_points = 6;
    double inlier_distance = 5.0;
    int maximum_models = 3;
    double confidence = 1.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, RansacParameters& p) {
    v("attempts", p.attempts, Range{1, 1000000}, "1",
      "hypotheses drawn for each primitive (k; the 2013 robot code: 100)");
    v("minimum_points", p.minimum_points, Range{2, 1000000}, "1", "points a primitive needs (n)");
    v("inlier_distance", p.inlier_distance, above(0), "px",
      "points nearer than this agree with a primitive (d)");
    v("maximum_models", p.maximum_models, Range{1, 1000}, "1",
      "primitives sought in each set of points (M_max)");
    v("confidence", p.confidence, Range{0, 1}, "1",
      "leave the hypotheses that remain when the best so far is, with this probability, as good as any; 1: "
      "never, which is the paper's result");
}

/// Hypotheses, of `attempts`, after which one that was drawn from inliers alone is among them with the
/// probability `confidence`, when `inliers` of `points` agree (Fischler and Bolles, 1981).
std::size_t attempts_needed(const RansacParameters& parameters, std::size_t inliers, std::size_t points,
                            std::size_t sample_size);

}  // namespace goalmouth
