#pragma once

#include "core/localisation/observation.h"
#include "core/localisation/sensor_model.h"
#include "core/random/random.h"

#include <optional>

namespace goalmouth {

/// A pose that fits what a frame shows, drawn with the measurements' errors and with no other idea of where
/// the robot is (sensor resetting: Lenser and Veloso, 2000). Two posts with distances give a pose outright;
/// one gives a circle of them. The field is point-symmetric: a pose and its mirror image are drawn alike.
/// Nothing where no pose on the carpet was found in a few tries, or the frame has no posts.
std::optional<Pose2> draw_pose(const FrameObservation& frame, const SensorModel& model, Random& random);

/// Body poses from which posts at `first` and `second` [m, in W] are seen under the azimuths `a1` and `a2`
/// [rad, in B] from a camera at `camera` [m, in B], the first at the distance `d1`. With γ = a2 − a1 and the
/// posts' distance b, the law of cosines gives the second's distance d2 = d1 cos γ ± √(b² − d1² sin² γ); the
/// pose follows from the two points. Of two solutions the one whose d2 is closer to `d2_guess` by its
/// inverse. Nothing where the angle cannot be.
struct PairPose {
    Pose2 pose;
    double second_distance = 0.0;
};
std::optional<PairPose> pose_from_pair(const Eigen::Vector2d& first, const Eigen::Vector2d& second,
                                       const Eigen::Vector2d& camera, double a1, double d1, double a2,
                                       double d2_guess);

/// The same place seen from the other half: turned by 180° about the field's centre.
Pose2 mirrored(const Pose2& pose);

}  // namespace goalmouth
