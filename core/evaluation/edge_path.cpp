#include "core/evaluation/edge_path.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace goalmouth {
namespace {

Eigen::Vector2d normalised_from_undistorted(const Intrinsics& camera, const Eigen::Vector2d& pixel) {
    return {(pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy};
}

std::array<EdgePath, 2> edges_at(const Intrinsics& camera, const Eigen::Isometry3d& T_WC,
                                 const Cylinder& post) {
    const auto edges = project_edges(camera, T_WC, post);
    if (!edges) return {EdgePath({}), EdgePath({})};
    return {bent_edge(camera, edges->left_top, edges->left_base),
            bent_edge(camera, edges->right_top, edges->right_base)};
}

/// What one row shows: its own path crosses it, or lies wholly below (its top is yet to come) or above it.
struct RowView {
    double row = 0.0;
    EdgePath path;
    double below_top() const { return row - path.top(); }
    double above_base() const { return path.base() - row; }
};

/// Where `gap`, negative at one of two rows, becomes 0 between them.
template <class End, class Gap>
Eigen::Vector2d end_between(const RowView& a, const RowView& b, End end, Gap gap) {
    const double share = gap(a) / (gap(a) - gap(b));
    return (1.0 - share) * end(a) + share * end(b);
}

EdgePath rolled_edge(const std::vector<RowView>& views) {
    const auto top_gap = [](const RowView& v) { return v.below_top(); };
    const auto base_gap = [](const RowView& v) { return v.above_base(); };
    const auto top_end = [](const RowView& v) { return v.path.at(v.path.top()); };
    const auto base_end = [](const RowView& v) { return v.path.at(v.path.base()); };
    std::vector<Eigen::Vector2d> points;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const RowView& view = views[i];
        if (i > 0 && views[i - 1].below_top() < 0.0 && view.below_top() >= 0.0)
            points.push_back(end_between(views[i - 1], view, top_end, top_gap));
        if (view.below_top() >= 0.0 && view.above_base() >= 0.0)
            points.emplace_back(view.path.x_at(view.row), view.row);
        if (i > 0 && views[i - 1].above_base() >= 0.0 && view.above_base() < 0.0)
            points.push_back(end_between(views[i - 1], view, base_end, base_gap));
    }
    return EdgePath(std::move(points));
}

}  // namespace

double EdgePath::x_at(double row) const {
    const auto below = std::lower_bound(points_.begin(), points_.end(), row,
                                        [](const Eigen::Vector2d& p, double y) { return p.y() < y; });
    if (below == points_.begin()) return points_.front().x();
    if (below == points_.end()) return points_.back().x();
    const Eigen::Vector2d& a = *std::prev(below);
    return a.x() + (row - a.y()) / (below->y() - a.y()) * (below->x() - a.x());
}

Eigen::Vector2d EdgePath::at(double row) const {
    const double y = std::clamp(row, top(), base());
    return {x_at(y), y};
}

EdgePath bent_edge(const Intrinsics& camera, const Eigen::Vector2d& top, const Eigen::Vector2d& base) {
    if (!camera.has_distortion()) return EdgePath({top, base});
    constexpr int steps = 256;
    const Eigen::Vector2d a = normalised_from_undistorted(camera, top);
    const Eigen::Vector2d along = normalised_from_undistorted(camera, base) - a;
    // From the point nearest to the optical axis outwards, until the model folds.
    const double nearest = std::clamp(-a.dot(along) / along.squaredNorm(), 0.0, 1.0);
    const auto walk = [&](double end) {
        std::vector<Eigen::Vector2d> walked;
        for (int i = 0; i <= steps && end != nearest; ++i) {
            const Eigen::Vector2d n = a + (nearest + (end - nearest) * i / steps) * along;
            if (folds_back(camera, n)) break;
            walked.push_back(pixel_from_normalised(camera, n));
        }
        return walked;
    };
    std::vector<Eigen::Vector2d> points = walk(0.0);
    std::reverse(points.begin(), points.end());
    const auto down = walk(1.0);
    if (!down.empty()) points.insert(points.end(), down.begin() + (points.empty() ? 0 : 1), down.end());
    return EdgePath(std::move(points));
}

std::array<EdgePath, 2> edges_in_picture(const Intrinsics& camera, const CameraMotion& motion,
                                         const ShutterParameters& shutter, const Cylinder& post) {
    if (motion.still() || shutter.readout == 0.0) return edges_at(camera, motion.T_WC, post);
    constexpr int pieces = 32;
    std::array<std::vector<RowView>, 2> views;
    for (int i = 0; i <= pieces; ++i) {
        const double row = -0.5 + camera.height * static_cast<double>(i) / pieces;
        auto paths = edges_at(camera, motion.at(row_time(shutter, row, camera.height)), post);
        for (std::size_t side = 0; side < 2; ++side)
            if (!paths[side].empty()) views[side].push_back({row, std::move(paths[side])});
    }
    return {rolled_edge(views[0]), rolled_edge(views[1])};
}

}  // namespace goalmouth
