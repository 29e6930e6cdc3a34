#pragma once

#include "core/field/field.h"
#include "core/localisation/observation.h"
#include "core/localisation/particle.h"
#include "core/parameters/parameters.h"

#include <array>
#include <cstddef>

namespace goalmouth {

/// How posts are told apart and how much they weigh.
struct SensorModelParameters {
    double clutter_share = 0.1;
    double clutter_azimuth_range = 1.05;
    double clutter_inverse_distance_range = 2.0;
    double wrong_side_share = 0.05;
    double correlation_time = 0.5;
    double off_field_sigma = 0.3;
};

template <class Visitor>
void describe_parameters(Visitor& v, SensorModelParameters& p) {
    v("clutter_share", p.clutter_share, Range{0.001, 0.9}, "1",
      "observed posts that are no post of the field");
    v("clutter_azimuth_range", p.clutter_azimuth_range, Range{0.1, 6.2832}, "rad",
      "false posts come anywhere in this range of bearings: the camera's field of view");
    v("clutter_inverse_distance_range", p.clutter_inverse_distance_range, Range{0.01, 20}, "1/m",
      "false posts come anywhere from infinity to the inverse of this distance");
    v("wrong_side_share", p.wrong_side_share, Range{0.001, 0.5}, "1",
      "posts named left or right of their goal by the detector that are the other one");
    v("correlation_time", p.correlation_time, Range{0, 60}, "s",
      "errors of posts in frames closer than this are alike; 0: every frame is news of its own");
    v("off_field_sigma", p.off_field_sigma, Range{0.01, 100}, "m",
      "σ of how far beyond the field's border strip the robot may be");
}

/// Probability of what a frame shows, given a pose.
///
/// Nobody says which post is which. With K = 4 posts in the field and the frame's observations z_1 … z_m, all
/// one-to-one assignments a to posts or to clutter (0) are summed, so two observations are never the same
/// post:
///
///     p(z | x) = Σ_a Π_i  ε c(z_i)  where a_i = 0,   (1 − ε) s(z_i, a_i) N(z_i; h(x, a_i), C_i) / K  else
///
/// z = (azimuth, 1/distance) or the azimuth alone; h what the pose expects; c uniform; ε `clutter_share`; s 1
/// − e, e or ½ as the detector's left/right agrees with the post, disagrees, or is not known (e
/// `wrong_side_share`). "Left" is as seen from the field: y > 0 at the opponents' goal, y < 0 at the own. The
/// sum is built observation by observation over sets of posts taken.
///
/// Where observations have an azimuth error in common (PostObservation::common_azimuth_variance s), the
/// product is over what is theirs alone, and the common error is integrated out of each assignment: with r_i
/// the azimuth's residual given that of 1/distance and v_i its variance, the product's factor is
///
///     exp(½ s S_1² / (1 + s S_0)) / √(1 + s S_0),    S_1 = Σ r_i / v_i,  S_0 = Σ 1 / v_i
///
/// over the observations that the assignment takes for posts. The assignments are then summed one by one.
class SensorModel {
  public:
    SensorModel(const Field& field, const SensorModelParameters& parameters);

    /// Observations of a frame that are weighed; more count as clutter.
    static constexpr std::size_t most_observations = 6;

    struct Likelihood {
        double log = 0.0;  // ln p(z | x); 0 without observations
        double explained =
            1.0;  // mean over the observations of the probability that each is a post of the field; 1 without
        std::array<double, most_observations>
            explained_each{};  // that probability, in the order of the observations
    };

    Likelihood likelihood(const Pose2& pose, const FrameObservation& frame) const;

    /// ln of the weight of being at a place: 0 on the carpet, falling off beyond it.
    double log_place(const Pose2& pose) const;

    /// Share of an independent measurement that a frame counts which comes `seconds` after the last frame
    /// with posts. Errors of a detector (shading, calibration, quantisation) persist while the view stays;
    /// for errors that fade as exp(−t/τ), frames Δt ≪ τ apart carry together as much as one every 2τ.
    /// Likelihoods are raised to min(1, Δt / 2τ).
    double news(double seconds) const;

    const std::array<Eigen::Vector2d, 4>& posts() const { return posts_; }
    /// True where the post can be what the detector names so.
    static bool is_side(std::size_t post, PostSide side);

  private:
    Likelihood likelihood_with_common_error(const Pose2& pose, const FrameObservation& frame) const;

    SensorModelParameters parameters_;
    std::array<Eigen::Vector2d, 4> posts_;
    double carpet_x_;
    double carpet_y_;
};

}  // namespace goalmouth
