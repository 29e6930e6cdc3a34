#pragma once

#include "core/geometry/pose2.h"
#include "core/localisation/particle.h"
#include "core/parameters/parameters.h"
#include "core/random/random.h"

namespace goalmouth {

/// How far odometry is trusted.
struct MotionParameters {
    double translation_noise = 0.2;
    double rotation_noise = 0.3;
    double translation_noise_length = 1.0;
    double rotation_noise_angle = 1.0;
    double drift = 0.1;
    double resting_position_noise = 0.02;
    double resting_heading_noise = 0.02;
    double unknown_position_noise = 0.25;
    double unknown_heading_noise = 0.5;
    double highest_speed = 2.0;
    double highest_turn_rate = 6.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, MotionParameters& p) {
    v("translation_noise", p.translation_noise, Range{0, 2}, "1",
      "σ of a walked distance as a fraction of it, where odometry does not say");
    v("rotation_noise", p.rotation_noise, Range{0, 2}, "1",
      "σ of a turned angle as a fraction of it, where odometry does not say");
    v("translation_noise_length", p.translation_noise_length, Range{0.01, 100}, "m",
      "walk over which translation_noise holds: errors of separate walks of this length are independent");
    v("rotation_noise_angle", p.rotation_noise_angle, Range{0.01, 100}, "rad",
      "turn over which rotation_noise holds: errors of separate turns of this angle are independent");
    v("drift", p.drift, Range{0, 2}, "rad/√m", "σ of the heading gained by walking a metre");
    v("resting_position_noise", p.resting_position_noise, Range{0, 1}, "m/√s",
      "σ of position gained each second, come what may");
    v("resting_heading_noise", p.resting_heading_noise, Range{0, 1}, "rad/√s",
      "σ of heading gained each second, come what may");
    v("unknown_position_noise", p.unknown_position_noise, Range{0, 5}, "m/√s",
      "σ of position gained each second without odometry");
    v("unknown_heading_noise", p.unknown_heading_noise, Range{0, 5}, "rad/√s",
      "σ of heading gained each second without odometry");
    v("highest_speed", p.highest_speed, Range{0.01, 100}, "m/s",
      "odometry that says more has jumped and is not believed");
    v("highest_turn_rate", p.highest_turn_rate, Range{0.01, 100}, "rad/s",
      "odometry that says more has jumped and is not believed");
}

/// What happened between two frames.
struct Motion {
    double seconds = 0.0;           // ≥ 0
    bool known = false;             // odometry held
    Pose2 step;                     // in the body frame at the start; zero where not known
    double translation_noise = -1;  // fractions as in odometry_t; −1 = unknown
    double rotation_noise = -1;
};

/// σ of the errors of a motion, in the body frame.
struct MotionSigma {
    double position = 0.0;  // [m] along and across alike
    double heading = 0.0;   // [rad]
};

/// A fraction f of the distance d stated by odometry is the σ of a walk of length ℓ
/// (`translation_noise_length`). Variance has to add up the same whether the walk comes in ten messages or a
/// thousand, so it grows with the distance:
///
///     σ_xy² = f_t² ℓ d + q_xy² Δt        σ_θ² = f_r² φ |Δθ| + c² d + q_θ² Δt
///
/// with φ `rotation_noise_angle`, c `drift`, q the noise gained by time. Without odometry only the last terms
/// are there.
MotionSigma motion_sigma(const Motion& motion, const MotionParameters& parameters);

/// True where no robot moves like that.
bool is_jump(const Motion& motion, const MotionParameters& parameters);

/// Moves every particle by the motion and a draw of its errors. The turn's error acts before and after the
/// step by halves.
void move_particles(Particles& particles, const Motion& motion, const MotionParameters& parameters,
                    Random& random);

}  // namespace goalmouth
