#include "core/localisation/pose_candidates.h"

#include <cmath>
#include <numbers>

namespace goalmouth {
namespace {

constexpr int pair_tries = 24;
constexpr int circle_tries = 12;

/// Azimuth and distance as they may have been without the measurement's error.
struct Draw {
    double azimuth;
    double distance;  // 0 where not measured
};

/// `common`: the error that all azimuths of the frame have alike, in its sigmas.
Draw draw(const PostObservation& z, double common, Random& random) {
    const double sa = std::sqrt(z.covariance(0, 0) - z.common_azimuth_variance);
    const double u = random.normal();
    Draw result{z.azimuth + sa * u, 0.0};
    if (z.common_azimuth_variance > 0.0) result.azimuth += std::sqrt(z.common_azimuth_variance) * common;
    if (z.has_distance) {
        const double slope = z.covariance(0, 1) / sa;
        const double rest = std::sqrt(std::max(0.0, z.covariance(1, 1) - slope * slope));
        const double inverse = z.inverse_distance + slope * u + rest * random.normal();
        result.distance = 1.0 / std::max(inverse, 0.2 * z.inverse_distance);
    }
    return result;
}

/// Nothing is drawn where nothing is in common.
double draw_common(const FrameObservation& frame, Random& random) {
    for (const PostObservation& z : frame.posts) {
        if (z.common_azimuth_variance > 0.0) return random.normal();
    }
    return 0.0;
}

/// The body whose camera stands at `camera_W` and sees `post` under `azimuth`.
Pose2 body_pose(const Eigen::Vector2d& camera_W, const Eigen::Vector2d& post, double azimuth,
                const Eigen::Vector2d& camera) {
    const Eigen::Vector2d towards = post - camera_W;
    const double theta = wrap_angle(std::atan2(towards.y(), towards.x()) - azimuth);
    const Eigen::Vector2d origin = transform({camera_W.x(), camera_W.y(), theta}, -camera);
    return {origin.x(), origin.y(), theta};
}

bool accept(double log_probability, Random& random) {
    return std::log(1.0 - random.uniform()) <= log_probability;
}

std::optional<Pose2> draw_from_pair(const FrameObservation& frame, const SensorModel& model, Random& random) {
    const auto count = static_cast<std::uint32_t>(frame.posts.size());
    for (int i = 0; i < pair_tries; ++i) {
        const std::uint32_t a = random.index(count);
        const std::uint32_t b = (a + 1 + random.index(count - 1)) % count;
        const std::uint32_t k = random.index(4);
        const std::uint32_t l = (k + 1 + random.index(3)) % 4;
        const PostObservation& za = frame.posts[a];
        const PostObservation& zb = frame.posts[b];
        if (!za.has_distance || !zb.has_distance) continue;
        if (!SensorModel::is_side(k, za.side) || !SensorModel::is_side(l, zb.side)) continue;
        const double common = draw_common(frame, random);
        const Draw da = draw(za, common, random);
        const Draw db = draw(zb, common, random);
        const auto found = pose_from_pair(model.posts()[k], model.posts()[l], frame.camera, da.azimuth,
                                          da.distance, db.azimuth, 1.0 / zb.inverse_distance);
        if (!found) continue;
        const double miss = 1.0 / found->second_distance - zb.inverse_distance;
        if (!accept(-0.5 * miss * miss / zb.covariance(1, 1) + model.log_place(found->pose), random))
            continue;
        return found->pose;
    }
    return std::nullopt;
}

std::optional<Pose2> draw_from_circle(const FrameObservation& frame, const SensorModel& model,
                                      Random& random) {
    const auto count = static_cast<std::uint32_t>(frame.posts.size());
    for (int i = 0; i < circle_tries; ++i) {
        const PostObservation& z = frame.posts[random.index(count)];
        const std::uint32_t k = random.index(4);
        if (!SensorModel::is_side(k, z.side)) continue;
        const Draw d = draw(z, draw_common(frame, random), random);
        const Eigen::Vector2d& post = model.posts()[k];
        // Where only the direction is known, any place as near as the far corners of the field is as good as
        // another.
        const double reach = 2.5 * post.norm();
        const double distance = d.distance > 0.0 ? d.distance : reach * std::sqrt(random.uniform());
        const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
        const Eigen::Vector2d camera_W = post + distance * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        const Pose2 pose = body_pose(camera_W, post, d.azimuth, frame.camera);
        if (accept(model.log_place(pose), random)) return pose;
    }
    return std::nullopt;
}

}  // namespace

std::optional<PairPose> pose_from_pair(const Eigen::Vector2d& first, const Eigen::Vector2d& second,
                                       const Eigen::Vector2d& camera, double a1, double d1, double a2,
                                       double d2_guess) {
    const double gamma = wrap_angle(a2 - a1);
    const double b = (second - first).norm();
    const double root = b * b - std::pow(d1 * std::sin(gamma), 2);
    if (!(root >= 0.0)) return std::nullopt;
    double d2 = 0.0;
    for (const double candidate :
         {d1 * std::cos(gamma) + std::sqrt(root), d1 * std::cos(gamma) - std::sqrt(root)}) {
        if (!(candidate > 0.02)) continue;
        const auto miss = [&](double d) { return std::abs(1.0 / d - 1.0 / d2_guess); };
        if (d2 == 0.0 || miss(candidate) < miss(d2)) d2 = candidate;
    }
    if (d2 == 0.0) return std::nullopt;
    const Eigen::Vector2d p1 = camera + d1 * Eigen::Vector2d(std::cos(a1), std::sin(a1));
    const Eigen::Vector2d p2 = camera + d2 * Eigen::Vector2d(std::cos(a2), std::sin(a2));
    const Eigen::Vector2d in_B = p2 - p1;
    const Eigen::Vector2d in_W = second - first;
    const double theta = wrap_angle(std::atan2(in_W.y(), in_W.x()) - std::atan2(in_B.y(), in_B.x()));
    const Eigen::Vector2d origin = first - transform({0, 0, theta}, p1);
    return PairPose{{origin.x(), origin.y(), theta}, d2};
}

Pose2 mirrored(const Pose2& pose) {
    return {-pose.x, -pose.y, wrap_angle(pose.theta + std::numbers::pi)};
}

std::optional<Pose2> draw_pose(const FrameObservation& frame, const SensorModel& model, Random& random) {
    int with_distance = 0;
    for (const PostObservation& z : frame.posts) with_distance += z.has_distance ? 1 : 0;
    if (with_distance >= 2) {
        if (const auto pose = draw_from_pair(frame, model, random)) return pose;
    }
    if (!frame.posts.empty()) return draw_from_circle(frame, model, random);
    return std::nullopt;
}

}  // namespace goalmouth
