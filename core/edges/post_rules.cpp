#include "core/edges/post_rules.h"

#include "core/edges/frame_scale.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

/// Of the rows on which a strip's surface is seen, the share that must show both edges.
constexpr double least_both = 0.4;

/// What of the largest taper may be widening from top to base.
constexpr double share_downwards = 0.7;

/// What its foot on the ground says of its size.
std::optional<std::string> why_not_there(const UprightStrip& strip, const CameraOverGround& view,
                                         const StripParameters& p, bool cut_at_top) {
    const double base = strip.base();
    const auto foot = ground_point(view.camera, view.T_BC, {strip.middle_at(base), base});
    if (!foot) return "its foot is above the horizon";
    const Eigen::Vector3d in_camera = view.T_BC.inverse() * Eigen::Vector3d(foot->x(), foot->y(), 0.0);
    const double expected = view.camera.fx * view.diameter / in_camera.z();  // px
    const double ratio = strip.width_at(base) / expected;
    if (ratio > p.width_ratio) return "too wide for its distance";
    if (ratio * p.width_ratio < 1.0) return "too narrow for its distance";

    const Eigen::Vector2d top =
        normalised_from_pixel(view.camera, {strip.middle_at(strip.top()), strip.top()});
    const Eigen::Vector3d ray = view.T_BC.linear() * Eigen::Vector3d(top.x(), top.y(), 1.0);
    const double away = (*foot - view.T_BC.translation().head<2>()).norm();
    const double height = view.T_BC.translation().z() + away * ray.z() / ray.head<2>().norm();  // m
    if (height > p.highest) return "too high for its distance";
    if (height < p.lowest && !cut_at_top) return "too low for its distance";
    return std::nullopt;
}

}  // namespace

std::optional<std::string> why_no_post(const UprightStrip& strip, const FrameEdges& frame,
                                       const Ground& ground, const FieldColour& field,
                                       const StripParameters& p, const EdgeThreshold& threshold,
                                       double straightness, int picture_width, int picture_height,
                                       const CameraOverGround* view) {
    const auto rows = static_cast<double>(std::count_if(
        strip.rows.begin(), strip.rows.end(), [](const StripRow& row) { return row.left || row.right; }));
    if (strip.both < p.least_rows || strip.both < least_both * rows) return "too few rows show both edges";
    if (strip.contrast < static_cast<double>(threshold.strength)) return "its surroundings look like it";

    const double upper = strip.width_at(strip.top());
    const double lower = strip.width_at(strip.base());
    const double width = 0.5 * (upper + lower);
    if (width < narrowest_px(p, picture_width)) return "narrow";
    // To a camera that looks down a post's foot is farther than its top, so it hardly widens downwards.
    const double taper = (lower > upper ? share_downwards : 1.0) * p.largest_taper * width;
    if (std::abs(upper - lower) > taper + straightness) return "tapers";
    const double step = frame.rows.size() > 1 ? frame.y(1) - frame.y(0) : 1.0;
    const double side = 4.0 * threshold.window;  // px, where no edge is found
    const bool cut_at_top = strip.top() < 2.0 * step;
    const bool cut =
        cut_at_top || strip.left.at(strip.top()) < side || strip.right.at(strip.top()) > picture_width - side;
    if (strip.length() < (cut ? p.least_aspect : p.least_whole_aspect) * width) return "short";
    if (strip.length() > p.largest_aspect * width) return "too high for its width";
    if (static_cast<double>(strip.inside.y) < p.least_brightness * static_cast<double>(field.luma()))
        return "darker than the field";

    const double border = ground.border_at(strip.middle_at(strip.base()));
    if (strip.base() < border - p.foot_tolerance * picture_height - step) return "ends above the field";
    const double rise = (border - strip.top()) / strip.length();
    const bool no_border_in_view = border < 4.0 * step;
    if (rise < p.least_rise && !(cut_at_top && no_border_in_view)) return "lies on the field";
    if (view != nullptr) return why_not_there(strip, *view, p, cut_at_top);
    return std::nullopt;
}

}  // namespace goalmouth
