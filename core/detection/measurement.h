#pragma once

#include "core/detection/post.h"
#include "core/geometry/camera.h"
#include "core/parameters/parameters.h"

namespace goalmouth {

struct MeasurementParameters {
    double edge_noise = 0.5;
    double distance_floor = 0.02;
    double bearing_floor = 0.01;
    double border_margin = 6.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, MeasurementParameters& p) {
    v("edge_noise", p.edge_noise, at_least(0), "px",
      "σ of an edge's place that does not shrink with more points (shading, blur, 4:2:2)");
    v("distance_floor", p.distance_floor, at_least(0), "1",
      "σ of the distance as a share of it, beside the edges' (focal length, diameter)");
    v("bearing_floor", p.bearing_floor, at_least(0), "rad",
      "σ of the bearing beside the edges' (lean, lens)");
    v("border_margin", p.border_margin, at_least(0), "px",
      "an edge that ends nearer to the image's border than this goes on beyond it");
}

/// γ: pixels per radian at the image's middle across a line that runs along `axis`, which is the paper's γ_x
/// for an upright post and any camera with fx = fy.
double pixel_angular_width(const Intrinsics& camera, const Eigen::Vector2d& axis);

/// Completes a post whose four corners, supports and edge-missing flags are set: cut flags, width, distance,
/// bearing, covariance.
///
/// Width     between the two edges, across their mean direction, at the post's middle; never 0.
///
/// Distance  (paper, section 5) d_w = w / w_px · γ, with `diameter` w in metres. It assumes that both edges
///           are the post's, that the post is parallel to the image plane (a standing robot looks level),
///           that its middle is near the image's (off the axis by φ, d_w comes out short by about cos²φ), and
///           that its outline is as wide as its diameter (a near cylinder shows less). With an edge missing
///           or fills_image there is none: no_distance, distance 0, and as variance that of 10 m.
///
/// Bearing   −atan(x/z) of the undistorted middle.
///
/// Covariance  `left_sigma` and `right_sigma` [px] say how well each edge is placed; edge_noise is added to
///           both. With w = r − l and m = (l + r)/2:
///               σ_w² = σ_l² + σ_r²,  σ_m² = σ_w²/4,  cov(w, m) = (σ_r² − σ_l²)/2,
///               dD = −D/w_px · dw  (= −D²/(w·γ) · dw),  dβ = −cos²β/γ_x · dm,
///           plus the floors.
void measure_post(Post& post, const Intrinsics& camera, double diameter, double left_sigma,
                  double right_sigma, const MeasurementParameters& parameters);

}  // namespace goalmouth
