#include "core/segmentation/scan_lines.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

std::vector<int> equidistant(int size, int spacing) {
    std::vector<int> positions;
    for (int at = std::min(spacing / 2, size - 1); at < size; at += spacing) positions.push_back(at);
    return positions;
}

/// Distance along the ground from the camera's foot to what row `y` sees at the image's middle column.
std::optional<double> ground_distance(const Intrinsics& camera, const Eigen::Isometry3d& T_BC, int y) {
    const auto ground = ground_point(camera, T_BC, {0.5 * (camera.width - 1), static_cast<double>(y)});
    if (!ground) return std::nullopt;
    return (*ground - T_BC.translation().head<2>()).norm();
}

}  // namespace

ScanLayout image_layout(int width, int height, const ScanLineParameters& parameters) {
    if (width <= 0 || height <= 0) return {};
    return {equidistant(height, parameters.row_spacing), equidistant(width, parameters.column_spacing)};
}

ScanLayout field_layout(const Intrinsics& camera, const std::optional<Eigen::Isometry3d>& T_BC,
                        const ScanLineParameters& parameters) {
    if (!T_BC || camera.width <= 0 || camera.height <= 0)
        return image_layout(camera.width, camera.height, parameters);
    std::optional<double> nearest = ground_distance(camera, *T_BC, camera.height - 1);
    if (!nearest) return image_layout(camera.width, camera.height, parameters);

    const int widest = std::max(parameters.largest_spacing, parameters.row_spacing);
    ScanLayout layout;
    int y = camera.height - 1;
    layout.rows.push_back(y);
    double last_distance = *nearest;
    for (int next = y - 1; next >= 0; --next) {
        if (y - next < parameters.row_spacing) continue;
        const auto distance = ground_distance(camera, *T_BC, next);
        const bool far_enough = !distance || std::abs(*distance - last_distance) >= parameters.field_spacing;
        if (!far_enough && y - next < widest) continue;
        y = next;
        layout.rows.push_back(y);
        if (distance) last_distance = *distance;
    }
    std::reverse(layout.rows.begin(), layout.rows.end());

    const int least = parameters.column_spacing;
    const double apart = std::round(camera.fx * parameters.field_spacing / parameters.column_distance);
    const double bounded = std::clamp(apart, static_cast<double>(least),
                                      static_cast<double>(std::max(parameters.largest_spacing, least)));
    layout.columns = equidistant(camera.width, static_cast<int>(bounded));
    return layout;
}

ScanLayout scan_layout(const Intrinsics& camera, const std::optional<Eigen::Isometry3d>& T_BC,
                       const ScanLineParameters& parameters) {
    if (parameters.spacing == "field") return field_layout(camera, T_BC, parameters);
    return image_layout(camera.width, camera.height, parameters);
}

const ScanLayout& LatestScanLayout::at(const Intrinsics& camera,
                                       const std::optional<Eigen::Isometry3d>& T_BC) {
    const auto same_pose = [&] {
        if (parameters_.spacing != "field") return true;
        return T_BC && T_BC_ ? T_BC->matrix() == T_BC_->matrix() : T_BC.has_value() == T_BC_.has_value();
    };
    if (known_ && camera == camera_ && same_pose()) return layout_;
    layout_ = scan_layout(camera, T_BC, parameters_);
    camera_ = camera;
    T_BC_ = T_BC;
    known_ = true;
    return layout_;
}

}  // namespace goalmouth
