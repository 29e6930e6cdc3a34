#include "core/refinement/distance_cues.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace goalmouth {
namespace {

double square(double x) {
    return x * x;
}

/// Change of a slope for a focal length that is told too long by a share, per that share.
double focal_change(const PostSilhouette& post, double slope) {
    constexpr double share = 1e-4;
    Eigen::Vector3d ray = post.ahead + slope * post.up;
    ray /= ray.z();
    ray.head<2>() *= 1.0 - share;
    return (ray.dot(post.up) / std::hypot(ray.dot(post.ahead), ray.dot(post.right)) - slope) / share;
}

struct Cue {
    DistanceCueKind kind;
    double distance;
    DistanceGradient change;

    double variance(const DistanceErrors& errors) const { return change * errors * change.transpose(); }
};

Cue base_cue(const PostSilhouette& post, const PostEnd& base, const CameraStance& camera, double radius) {
    Cue cue{DistanceCueKind::base, radius - camera.height / base.slope, DistanceGradient::Zero()};
    const double per_slope = camera.height / square(base.slope);
    using namespace distance_error;
    cue.change[base_end] = per_slope;
    cue.change[step + silhouette_part::lean] = -per_slope * (1.0 + square(base.slope));
    cue.change[camera_height] = -1.0 / base.slope;
    cue.change[focal] = per_slope * focal_change(post, base.slope);
    cue.change[diameter] = radius;
    return cue;
}

Cue height_cue(const PostSilhouette& post, const PostEnd& base, const PostEnd& top, double height,
               double radius) {
    const double between = top.slope - base.slope;
    const double side = top.slope > 0.0 ? -1.0 : 1.0;  // of the rim, from the axis
    const double rims = side * top.slope + base.slope;
    const double distance = (height - radius * rims) / between;
    Cue cue{DistanceCueKind::crossbar, distance, DistanceGradient::Zero()};
    const double per_base = (distance - radius) / between;
    const double per_top = -(distance + side * radius) / between;
    using namespace distance_error;
    cue.change[base_end] = per_base;
    cue.change[top_end] = per_top;
    cue.change[step + silhouette_part::lean] =
        -per_base * (1.0 + square(base.slope)) - per_top * (1.0 + square(top.slope));
    cue.change[focal] = per_base * focal_change(post, base.slope) + per_top * focal_change(post, top.slope);
    cue.change[diameter] = radius * (1.0 - rims) / between;
    cue.change[goal_height] = 1.0 / between;
    return cue;
}

}  // namespace

CombinedDistance combine_distances(const PostEstimate& width, const PostSilhouette& post,
                                   const PostEnds& ends, const std::optional<CameraStance>& camera,
                                   double lean_sigma, const Field& field,
                                   const RefinementParameters& parameters) {
    CombinedDistance result;
    result.estimate = width;
    DistanceErrors& errors = result.estimate.errors;
    const double radius = 0.5 * field.post_diameter;
    using namespace distance_error;
    if (ends.base) errors(base_end, base_end) = square(ends.base->sigma * ends.base->per_px);
    if (ends.top) errors(top_end, top_end) = square(ends.top->sigma * ends.top->per_px);
    errors(goal_height, goal_height) = square(parameters.goal_error);
    if (camera) {
        errors(camera_height, camera_height) = camera->variance;
        // Of the measured vertical's error the fit keeps a part, and moves by it.
        constexpr int lean = step + silhouette_part::lean;
        const double with_lean = -camera->with_up.dot(post.ahead) / square(lean_sigma);
        const Eigen::Vector4d kept = errors.block<4, 1>(step, lean) * with_lean;
        errors.block<4, 1>(step, camera_height) = kept;
        errors.block<1, 4>(camera_height, step) = kept.transpose();
    }

    std::vector<Cue> cues = {{DistanceCueKind::width, width.distance, width.distance_change}};
    if (parameters.base_cue && ends.base && camera && camera->height > 0.0)
        cues.push_back(base_cue(post, *ends.base, *camera, radius));
    if (parameters.height_cue && ends.base && ends.top && ends.top->slope > ends.base->slope)
        cues.push_back(height_cue(post, *ends.base, *ends.top, field.goal_height + radius, radius));

    std::vector<DistanceGradient> changes = {width.distance_change, width.bearing_change};
    std::vector<double> values = {width.distance, width.bearing};
    for (const Cue& cue : cues) {
        const double variance = cue.variance(errors);
        if (!(cue.distance > 0.0) || !std::isfinite(variance) || !(variance > 0.0)) continue;
        result.cues.push_back({cue.kind, cue.distance, std::sqrt(variance)});
        if (cue.kind == DistanceCueKind::width) continue;
        const DistanceGradient apart = cue.change - width.distance_change;
        const double sigma = std::sqrt(apart * errors * apart.transpose());
        const double off = std::abs(cue.distance - width.distance) / sigma;
        // First order holds for no farther than this.
        constexpr double straight = 0.3;
        if (!(off <= parameters.cue_gate) || std::sqrt(variance) > straight * cue.distance) continue;
        changes.push_back(cue.change);
        values.push_back(cue.distance);
    }
    const auto n = static_cast<Eigen::Index>(values.size());
    if (n == 2) return result;
    Eigen::MatrixXd change(n, distance_error::count), design = Eigen::MatrixXd::Zero(n, 2);
    Eigen::VectorXd value(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        change.row(i) = changes[static_cast<std::size_t>(i)];
        value[i] = values[static_cast<std::size_t>(i)];
        design(i, i == 1 ? 1 : 0) = 1.0;
    }
    const Eigen::LDLT<Eigen::MatrixXd> covariance(change * errors * change.transpose());
    const Eigen::MatrixXd weighted = covariance.solve(design);
    const Eigen::Matrix2d information = design.transpose() * weighted;
    const Eigen::MatrixXd gain = information.ldlt().solve(weighted.transpose());
    const Eigen::Vector2d best = gain * value;
    if (!gain.allFinite() || !best.allFinite() || !(best[0] > 0.0)) return result;
    result.estimate.distance = best[0];
    result.estimate.bearing = best[1];
    result.estimate.distance_change = gain.row(0) * change;
    result.estimate.bearing_change = gain.row(1) * change;
    return result;
}

}  // namespace goalmouth
