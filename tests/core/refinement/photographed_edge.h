#pragma once

#include "core/random/random.h"
#include "core/refinement/bound.h"

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

// What a camera makes of straight edges, and what whoever knows levels, noise and blur can tell from it. None
// of it uses the code under test.

namespace goalmouth::test {

/// (Y, Cb − 128, Cr − 128).
Eigen::Vector3d from_rgb(const Eigen::Vector3d& rgb);

extern const Eigen::Vector3d yellow, grey, carpet;

/// Noise as variance of each of red, green and blue in a pixel.
EdgeLook yellow_before(const Eigen::Vector3d& background, double post_noise = 16.0,
                       double background_noise = 16.0);

/// Share of a pixel's light that comes from the far side of an edge, by the distance of its centre from it:
/// the blur's step averaged over the pixel's square, tabulated.
class Coverage {
  public:
    Coverage(double blur, const Eigen::Vector2d& normal);
    double operator()(double t) const;

  private:
    static constexpr double reach_ = 8.0;  // px
    static constexpr int count_ = 1600;
    std::vector<double> table_;
};

/// Pairs of pixels of a 4:2:2 picture as (mean Y, Cb, Cr): the pair's left pixel, x even.
struct Pair {
    int x = 0;
    int y = 0;
    const EdgeLook* look = nullptr;
};

/// Share of the post in each of a pair's pixels.
using Covered = std::function<double(double x, double y)>;

/// Takes a picture: each pixel of the post with a brightness of its own, noise in each pixel, chroma averaged
/// over the pair, levels rounded.
std::vector<Eigen::Vector3d> photograph(const std::vector<Pair>& pairs, const Covered& covered,
                                        Random& random);

/// Fits by maximum likelihood in the complement of `yellow`: Gauss and Newton's steps, derivatives by
/// differences of `steps`. `covered_by` gives the picture that parameters predict.
Eigen::VectorXd fit(const std::vector<Pair>& pairs, const std::vector<Eigen::Vector3d>& values,
                    const std::function<Covered(const Eigen::VectorXd&)>& covered_by, Eigen::VectorXd guess,
                    const Eigen::VectorXd& steps);

/// What `tries` errors must show of a bound: their RMSE reaches it within a few per cent, and is not
/// significantly less.
void expect_reached(const std::vector<double>& errors, double bound);

}  // namespace goalmouth::test
