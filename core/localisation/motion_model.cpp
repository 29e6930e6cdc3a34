#include "core/localisation/motion_model.h"

#include <cmath>

namespace goalmouth {

MotionSigma motion_sigma(const Motion& motion, const MotionParameters& parameters) {
    const double t = std::max(0.0, motion.seconds);
    const auto square = [](double a) { return a * a; };
    if (!motion.known) {
        return {parameters.unknown_position_noise * std::sqrt(t),
                parameters.unknown_heading_noise * std::sqrt(t)};
    }
    const double f_t =
        motion.translation_noise >= 0.0 ? motion.translation_noise : parameters.translation_noise;
    const double f_r = motion.rotation_noise >= 0.0 ? motion.rotation_noise : parameters.rotation_noise;
    const double d = std::hypot(motion.step.x, motion.step.y);
    const double turn = std::abs(wrap_angle(motion.step.theta));
    return {std::sqrt(square(f_t) * parameters.translation_noise_length * d +
                      square(parameters.resting_position_noise) * t),
            std::sqrt(square(f_r) * parameters.rotation_noise_angle * turn + square(parameters.drift) * d +
                      square(parameters.resting_heading_noise) * t)};
}

bool is_jump(const Motion& motion, const MotionParameters& parameters) {
    // A tenth of a second's worth is let through: capture times jitter.
    const double t = std::max(0.0, motion.seconds) + 0.1;
    return std::hypot(motion.step.x, motion.step.y) > parameters.highest_speed * t ||
           std::abs(wrap_angle(motion.step.theta)) > parameters.highest_turn_rate * t;
}

void move_particles(Particles& particles, const Motion& motion, const MotionParameters& parameters,
                    Random& random) {
    const MotionSigma sigma = motion_sigma(motion, parameters);
    for (Particle& p : particles) {
        const double turn_error = sigma.heading * random.normal();
        const Pose2 half{0.0, 0.0, 0.5 * turn_error};
        const Pose2 step{motion.step.x + sigma.position * random.normal(),
                         motion.step.y + sigma.position * random.normal(), motion.step.theta};
        p.pose = compose(compose(compose(p.pose, half), step), half);
    }
}

}  // namespace goalmouth
