#pragma once

#include "core/field/field.h"
#include "core/geometry/camera.h"
#include "core/geometry/pose2.h"
#include "core/localisation/motion_model.h"
#include "core/localisation/observation.h"
#include "core/random/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Core>

// A little world with known truth: what an error-free camera would see, by projection of tangent lines to
// cylinders, and what a filter would be told about it, with noise. Nothing here uses the code under test.
namespace goalmouth::test {

inline Eigen::Isometry3d body_in_field(const Pose2& pose) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = Eigen::AngleAxisd(pose.theta, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    T.translation() = Eigen::Vector3d(pose.x, pose.y, 0.0);
    return T;
}

/// The silhouette of a vertical cylinder at `axis` [m, in W] between two heights; nothing where part of it is
/// behind the camera.
inline std::optional<Post> see_post(const Eigen::Vector2d& axis, double radius, double from, double to,
                                    const Eigen::Isometry3d& T_WC, const Intrinsics& camera) {
    const Eigen::Vector2d c = T_WC.translation().head<2>();
    const Eigen::Vector2d d = axis - c;
    const double distance = d.norm();
    if (distance <= radius) return std::nullopt;
    // Tangent points on the cylinder's circle: at the angle acos(r/D) from the direction back to the camera.
    const double back = std::atan2(-d.y(), -d.x());
    const double open = std::acos(radius / distance);
    const auto pixel = [&](double side, double height) {
        const Eigen::Vector2d t =
            axis + radius * Eigen::Vector2d(std::cos(back + side * open), std::sin(back + side * open));
        return project(camera, T_WC.inverse() * Eigen::Vector3d(t.x(), t.y(), height));
    };
    // Seen from the camera, the tangent point clockwise of the way back (−) is to the left.
    const auto lt = pixel(-1, to);
    const auto lb = pixel(-1, from);
    const auto rt = pixel(1, to);
    const auto rb = pixel(1, from);
    if (!lt || !lb || !rt || !rb) return std::nullopt;
    Post post;
    post.left_top = *lt;
    post.left_base = *lb;
    post.right_top = *rt;
    post.right_base = *rb;
    const Eigen::Vector2d along = (0.5 * (*lb + *rb) - 0.5 * (*lt + *rt)).normalized();
    const Eigen::Vector2d across{along.y(), -along.x()};
    post.width_px = std::abs(across.dot(0.5 * (*rt + *rb) - 0.5 * (*lt + *lb)));
    post.distance_m = distance;
    const Eigen::Vector2d middle = normalised_from_pixel(camera, 0.25 * (*lt + *lb + *rt + *rb));
    post.bearing_rad = -std::atan(middle.x());
    return post;
}

/// Errors of observations: a part that is new in every frame and a part that fades with e^(−t/τ), per post.
struct ObservationNoise {
    double azimuth = 0.03;   // rad
    double fraction = 0.10;  // of distance, as σ of D · (1/D)
    double fade = 0.0;       // s; 0: new in every frame
};

/// A robot that walks and looks about, with odometry errors of its own.
class Walker {
  public:
    Walker(const Field& field, const Pose2& start, std::uint64_t seed)
        : field_(field), pose_(start), random_(seed) {
        for (auto& e : azimuth_error_) e = random_.normal();
        for (auto& e : distance_error_) e = random_.normal();
    }

    const Pose2& pose() const { return pose_; }
    void put(const Pose2& pose) { pose_ = pose; }
    Random& random() { return random_; }

    /// Walks by `step` and says what odometry makes of it, with the errors the motion model states.
    Motion walk(const Pose2& step, double seconds, const MotionParameters& noise) {
        Motion motion;
        motion.seconds = seconds;
        motion.known = true;
        motion.step = step;
        const MotionSigma sigma = motion_sigma(motion, noise);
        const Pose2 real{step.x + sigma.position * random_.normal(),
                         step.y + sigma.position * random_.normal(),
                         step.theta + sigma.heading * random_.normal()};
        pose_ = compose(pose_, real);
        return motion;
    }

    /// Posts within ±range of the direction `look` [rad, in B].
    FrameObservation look(double look, double range, double seconds, const ObservationNoise& noise,
                          bool distances = true) {
        FrameObservation frame;
        frame.camera = {0.02, 0.01};
        const Eigen::Vector2d camera = transform(pose_, frame.camera);
        const double keep = noise.fade > 0.0 ? std::exp(-seconds / noise.fade) : 0.0;
        const auto posts = field_.posts();
        for (std::size_t k = 0; k < posts.size(); ++k) {
            azimuth_error_[k] = keep * azimuth_error_[k] + std::sqrt(1.0 - keep * keep) * random_.normal();
            distance_error_[k] = keep * distance_error_[k] + std::sqrt(1.0 - keep * keep) * random_.normal();
            const Eigen::Vector2d d = posts[k] - camera;
            const double azimuth = wrap_angle(std::atan2(d.y(), d.x()) - pose_.theta);
            if (std::abs(wrap_angle(azimuth - look)) > range) continue;
            PostObservation z;
            z.azimuth = wrap_angle(azimuth + noise.azimuth * azimuth_error_[k]);
            z.covariance(0, 0) = noise.azimuth * noise.azimuth;
            if (distances) {
                z.has_distance = true;
                const double sigma = noise.fraction / d.norm();
                z.inverse_distance = std::max(0.01, 1.0 / d.norm() + sigma * distance_error_[k]);
                z.covariance(1, 1) = sigma * sigma;
            }
            frame.posts.push_back(z);
        }
        return frame;
    }

    /// Azimuth of the nearer-in-heading goal's middle: a head that tracks a goal.
    double goal_azimuth() const {
        const double side = std::cos(pose_.theta) >= 0.0 ? 1.0 : -1.0;
        const Eigen::Vector2d d = Eigen::Vector2d(side * field_.length / 2.0, 0.0) - pose_.position();
        return wrap_angle(std::atan2(d.y(), d.x()) - pose_.theta);
    }

  private:
    Field field_;
    Pose2 pose_;
    Random random_;
    double azimuth_error_[4];
    double distance_error_[4];
};

inline double position_error(const Pose2& a, const Pose2& b) {
    return (a.position() - b.position()).norm();
}
inline double heading_error(const Pose2& a, const Pose2& b) {
    return std::abs(wrap_angle(a.theta - b.theta));
}

}  // namespace goalmouth::test
