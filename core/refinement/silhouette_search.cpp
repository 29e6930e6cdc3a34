#include "core/refinement/silhouette_search.h"

#include "core/refinement/post_stand.h"
#include "core/refinement/run_ends.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

constexpr int least_rows = 8;  // px
constexpr std::array<OutlineSide, 2> sides = {OutlineSide::left, OutlineSide::right};

/// The silhouette that one plane and a guess of the half angle make.
PostSilhouette silhouette_from(const Eigen::Vector3d& plane, OutlineSide side, const Eigen::Vector3d& up,
                               double half_angle) {
    PostSilhouette post;
    post.up = (up - up.dot(plane) * plane).normalized();
    const Eigen::Vector3d across = post.up.cross(plane);
    const double sign = side == OutlineSide::left ? 1.0 : -1.0;
    post.right = (sign * std::cos(half_angle) * plane - std::sin(half_angle) * across).normalized();
    post.ahead = post.up.cross(post.right);
    post.half_angle = half_angle;
    return post;
}

double rough_half_angle(const RoughOutline& outline, const Intrinsics& camera) {
    const double row = 0.5 * (outline.first_row + outline.last_row);
    const double left = std::atan(normalised_from_pixel(camera, {outline.left(row), row}).x());
    const double right = std::atan(normalised_from_pixel(camera, {outline.right(row), row}).x());
    return 0.5 * std::abs(right - left);
}

/// Where to start from, and what is known about it.
PostSilhouette start_of(const SilhouetteTask& task, const CoarseEdgeFinder::Edges& edges,
                        const std::array<bool, 2>& use, SilhouettePrior& prior) {
    const MeasuredVertical& vertical = task.vertical;
    PostSilhouette start;
    prior = {};
    prior.up = vertical.up;
    if (use[0] && use[1]) {
        start = silhouette_between(edges[0]->plane, edges[1]->plane, vertical.up);
    } else {
        const std::size_t side = use[0] ? 0 : 1;
        // Of a post that the picture's border cuts more is hidden than an outline shows.
        const double half_angle = (task.cut ? 1.5 : 1.0) * rough_half_angle(task.outline, task.camera);
        constexpr double least_sigma = 0.02;  // rad; a post half a metre away: 0.1, six metres: 0.008
        start = silhouette_from(edges[side]->plane, sides[side], vertical.up, half_angle);
        prior.half_angle = half_angle;
        prior.half_angle_sigma = std::max(0.5 * half_angle, least_sigma);
    }
    constexpr double surest = 1e-6;  // rad; its square has to have an inverse
    prior.lean_sigma = std::max(surest, vertical.sigma_about(start.ahead));
    // While a picture's rows are read one by one the camera turns: half a rad/s are 0.02 over 30 ms.
    constexpr double shutter_slant = 0.02;
    prior.roll_sigma = std::hypot(shutter_slant, vertical.sigma_about(start.right));
    return start;
}

/// The plane of an edge, or of where it is instead.
Eigen::Vector3d moved_plane(const PostSilhouette& post, std::size_t side, const RivalVerdict& rival,
                            const Intrinsics& camera) {
    const Eigen::Vector3d plane = post.plane(side == 0 ? OutlineSide::left : OutlineSide::right);
    if (!rival.moved) return plane;
    const double outwards = side == 0 ? -1.0 : 1.0;
    const Eigen::Vector2d pixel(rival.at->edge + outwards * rival.at->beyond, rival.at->y);
    const Eigen::Vector2d ray = normalised_from_pixel(camera, pixel);
    const Eigen::Vector3d moved = post.up.cross(Eigen::Vector3d(ray.x(), ray.y(), 1.0)).normalized();
    return moved.dot(plane) < 0.0 ? -moved : moved;
}

}  // namespace

void SilhouetteSearch::attempt(YuyvView image, const SilhouetteTask& task, const std::array<bool, 2>& use,
                               const LeftOut& left_out, FoundSilhouette& found) {
    const PostSilhouette start = start_of(task, found.edges, use, found.prior);
    const auto fails = [&](const char* why) { found.problem = why; };
    if (!(start.half_angle > 0.0)) return fails("its edges cross");
    found.extent = find_extent(image, start, task.colour, task.camera, task.outline);
    const PostExtent& extent = found.extent;
    if (extent.last_edge_row - extent.first_edge_row + 1 < least_rows)
        return fails("too few rows of its colour");
    found.layout = layout_rows(extent.first_edge_row, extent.last_edge_row, parameters_.most_rows);
    found.fit = fitter_.fit(image, task.camera, task.colour, start, found.prior, found.layout, use, left_out,
                            parameters_.least_contrast);
    const SilhouetteFit& fit = found.fit;
    if (!(fit.covariance.allFinite() && fit.covariance.diagonal().minCoeff() > 0.0) ||
        fit.scatter.agreeing == std::array<int, 2>{})
        return fails("no edge in its pixels");
    const auto ends = run_ends(image, fit.post, task.colour, task.camera, extent, fit.blur);
    PostStand stand = post_stand(fit.post, extent, task.vertical.camera,
                                 task.vertical.sigma_about(fit.post.ahead), task.camera, field_);
    // Of one edge the width is a guess.
    stand.sinks = stand.sinks && use[0] && use[1];
    for (std::size_t side = 0; side < 2; ++side)
        if (use[side])
            found.rivals[side] = judge_rivals(image, ends[side], side == 0 ? -1 : 1, stand, fit.blur);
    if (stand.sinks && !found.rivals[0].moved && !found.rivals[1].moved)
        fails("its foot is nearer than its width");
}

FoundSilhouette SilhouetteSearch::find(YuyvView image, const SilhouetteTask& task,
                                       const CoarseEdgeFinder::Edges& edges, const std::array<bool, 2>& use) {
    FoundSilhouette found;
    found.edges = edges;
    LeftOut left_out;
    std::array<bool, 2> was_moved{};
    for (;;) {
        attempt(image, task, use, left_out, found);
        if (!found.problem.empty() || !use[0] || !use[1]) return found;
        std::array<bool, 2> moves{};
        for (std::size_t side = 0; side < 2; ++side) moves[side] = found.rivals[side].moved.has_value();
        if (!moves[0] && !moves[1]) return found;
        if ((moves[0] && was_moved[0]) || (moves[1] && was_moved[1])) {
            found.problem = "its pixels fit badly";
            return found;
        }
        for (std::size_t side = 0; side < 2; ++side) {
            was_moved[side] = was_moved[side] || moves[side];
            left_out[side] = found.rivals[side].left_out;
            found.edges[side]->plane = moved_plane(found.fit.post, side, found.rivals[side], task.camera);
            if (moves[side]) found.edges[side]->rival = 0.0;
        }
    }
}

}  // namespace goalmouth
