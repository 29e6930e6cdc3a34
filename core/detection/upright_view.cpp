#include "core/detection/upright_view.h"

#include "core/geometry/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

namespace goalmouth {
namespace {

/// Where the lens says something, and not along the vertical.
bool usable(const UprightRay& ray) {
    constexpr double steepest = 1e3;
    return std::isfinite(ray.azimuth) && std::abs(ray.slope) < steepest;
}

/// A picture shows hundreds of edge points and of stretches of a colour; of noise that many more come evenly.
template <class Item>
void thin(std::vector<Item>& items) {
    constexpr std::size_t most = 4000;
    if (items.size() <= most) return;
    for (std::size_t i = 0; i < most; ++i) items[i] = items[i * items.size() / most];
    items.resize(most);
}

}  // namespace

std::optional<UprightView> UprightView::make(const Intrinsics& camera, const std::optional<CameraPose>& pose,
                                             double level_sigma) {
    UprightView view;
    view.camera_ = camera;
    view.up_ = -Eigen::Vector3d::UnitY();
    view.attitude_sigma_ = level_sigma;
    if (pose && pose->T_BC.matrix().allFinite() && pose->covariance.allFinite()) {
        view.up_ = pose->T_BC.linear().transpose() * Eigen::Vector3d::UnitZ();
        view.attitude_sigma_ =
            std::sqrt(std::max(0.0, 0.5 * (pose->covariance(3, 3) + pose->covariance(4, 4))));
        const double height = pose->T_BC.translation().z();
        if (height > 0.0) view.height_ = height;
    }
    const Eigen::Vector3d ahead =
        Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ().dot(view.up_) * view.up_;
    constexpr double least_level = 0.1;  // cosine of the axis's elevation
    if (!(ahead.norm() > least_level)) return std::nullopt;
    view.ahead_ = ahead.normalized();
    view.right_ = view.ahead_.cross(view.up_);
    return view;
}

UprightRay UprightView::ray(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector3d d = normalised_from_pixel(camera_, pixel).homogeneous();
    const double ahead = d.dot(ahead_), right = d.dot(right_);
    return {std::atan2(right, ahead), d.dot(up_) / std::hypot(right, ahead)};
}

std::optional<Eigen::Vector2d> UprightView::pixel(const UprightRay& ray) const {
    return project(camera_,
                   std::cos(ray.azimuth) * ahead_ + std::sin(ray.azimuth) * right_ + ray.slope * up_);
}

void UprightCandidates::take(const Candidates& candidates, const UprightView& view) {
    find_rows(candidates);
    const auto row_at = [&](double y) {
        const auto i = std::lround(y);
        return i < 0 || i >= static_cast<long>(row_of_.size()) ? -1 : row_of_[static_cast<std::size_t>(i)];
    };
    const auto convert = [&](const std::vector<Eigen::Vector2d>& from, std::vector<UprightPoint>& to) {
        to.clear();
        for (const Eigen::Vector2d& p : from)
            if (const UprightRay ray = view.ray(p); usable(ray)) to.push_back({ray, p, row_at(p.y())});
        thin(to);
    };
    convert(candidates.left_edges, left);
    convert(candidates.right_edges, right);
    runs.clear();
    for (const CandidateSegment& s : candidates.segments) {
        if (s.orientation != Orientation::horizontal) continue;
        const UprightRay start = view.ray({s.start - 0.5, s.line}), end = view.ray({s.end + 0.5, s.line});
        if (usable(start) && usable(end))
            runs.push_back({start, end, row_at(s.line), s.start <= 0, s.end >= candidates.width - 1});
    }
    thin(runs);
    field.clear();
    for (const FieldRun& f : candidates.field) {
        const UprightRay start = view.ray({f.start - 0.5, f.line}), end = view.ray({f.end + 0.5, f.line});
        if (usable(start) && usable(end)) field.push_back({start, end, row_at(f.line), false, false});
    }
    thin(field);
    find_border(candidates, view);
}

void UprightCandidates::find_border(const Candidates& candidates, const UprightView& view) {
    border.clear();
    field_ends_.clear();
    for (const FieldRun& f : candidates.field) {
        field_ends_.emplace_back(f.start, f.line);
        field_ends_.emplace_back(f.end, f.line);
    }
    if (field_ends_.empty()) return;
    upper_hull(field_ends_, hull_);
    constexpr int columns = 64;  // straight in the picture is not straight about the vertical
    const double first = hull_.front().x(), step = (hull_.back().x() - first) / columns;
    for (int i = 0; i <= columns; ++i) {
        const double x = first + i * step;
        const UprightRay ray = view.ray({x, chain_y_at(hull_, x)});
        if (usable(ray) && (border.empty() || ray.azimuth > border.back().x()))
            border.emplace_back(ray.azimuth, ray.slope);
    }
}

void UprightCandidates::find_rows(const Candidates& candidates) {
    rows.clear();
    for (const FieldRun& f : candidates.field)
        if (f.line >= 0 && f.line < candidates.height) rows.push_back(f.line);
    for (const CandidateSegment& s : candidates.segments)
        if (s.orientation == Orientation::horizontal && s.line >= 0 && s.line < candidates.height)
            rows.push_back(s.line);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    if (rows.size() > 1) {
        steps_.clear();
        for (std::size_t i = 0; i + 1 < rows.size(); ++i) steps_.push_back(rows[i + 1] - rows[i]);
        const auto middle = steps_.begin() + static_cast<std::ptrdiff_t>(steps_.size() / 2);
        std::nth_element(steps_.begin(), middle, steps_.end());
        const int step = *middle;
        all_.clear();
        for (int row = rows.front() - step; row >= 0; row -= step) all_.push_back(row);
        std::reverse(all_.begin(), all_.end());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (i > 0) {
                const int between = rows[i] - rows[i - 1];
                const int missing = (between + step / 2) / step - 1;
                for (int k = 1; k <= missing; ++k) all_.push_back(rows[i - 1] + k * between / (missing + 1));
            }
            all_.push_back(rows[i]);
        }
        for (int row = rows.back() + step; row < candidates.height; row += step) all_.push_back(row);
        rows.swap(all_);
    }
    row_of_.assign(static_cast<std::size_t>(std::max(0, candidates.height)), -1);
    for (std::size_t i = 0; i < rows.size(); ++i)
        row_of_[static_cast<std::size_t>(rows[i])] = static_cast<int>(i);
}

}  // namespace goalmouth
