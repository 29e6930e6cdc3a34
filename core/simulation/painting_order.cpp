#include "core/simulation/painting_order.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {
namespace {

using Eigen::Vector3d;

/// The points of two segments that are closest to each other.
std::pair<Vector3d, Vector3d> closest_points(const SeenBody& a, const SeenBody& b) {
    const Vector3d u = a.to - a.from;
    const Vector3d v = b.to - b.from;
    const Vector3d w = a.from - b.from;
    const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
    const double uw = u.dot(w), vw = v.dot(w);
    const auto unit = [](double value) { return std::clamp(value, 0.0, 1.0); };
    const double area = uu * vv - uv * uv;  // 0: parallel
    double s = area > 1e-12 * uu * vv ? unit((uv * vw - vv * uw) / area) : 0.0;
    double t = vv > 0.0 ? (uv * s + vw) / vv : 0.0;
    // Where the other end is beyond its segment, it is cut and this one follows.
    if (t != unit(t) || !(vv > 0.0)) {
        t = unit(t);
        s = uu > 0.0 ? unit((uv * t - uw) / uu) : 0.0;
    }
    return {a.from + s * u, b.from + t * v};
}

bool overlap(const PixelBox& a, const PixelBox& b) {
    return a.left <= b.right && b.left <= a.right && a.top <= b.bottom && b.top <= a.bottom;
}

class Order {
  public:
    explicit Order(std::span<std::unique_ptr<SeenObject>> objects) : behind_(objects.size()) {
        for (std::size_t far = 0; far < objects.size(); ++far)
            for (std::size_t near = far + 1; near < objects.size(); ++near) {
                if (!overlap(objects[far]->box(), objects[near]->box())) continue;
                const Hiding which = hiding(objects[far]->body(), objects[near]->body());
                if (which == Hiding::none) continue;
                const bool turned = which == Hiding::by_first;
                if (turned) behind_[far].push_back(near);
                if (!turned) behind_[near].push_back(far);
                detours_ = detours_ || turned;
            }
    }

    bool detours() const { return detours_; }

    /// Each after all that it may hide, otherwise as they stand.
    std::vector<std::size_t> run() {
        visited_.assign(behind_.size(), false);
        for (std::size_t i = 0; i < behind_.size(); ++i) visit(i);
        return std::move(order_);
    }

  private:
    void visit(std::size_t i) {
        if (visited_[i]) return;  // or in a circle: then the distance decides
        visited_[i] = true;
        for (const std::size_t k : behind_[i]) visit(k);
        order_.push_back(i);
    }

    std::vector<std::vector<std::size_t>> behind_;
    std::vector<bool> visited_;
    std::vector<std::size_t> order_;
    bool detours_ = false;
};

}  // namespace

Hiding hiding(const SeenBody& first, const SeenBody& second) {
    const auto [p, q] = closest_points(first, second);
    const Vector3d way = q - p;
    const double length = way.norm();
    const double reach = first.radius + second.radius;
    const double gap = length - reach;
    if (gap <= 0.0 && length <= 0.2 * reach) return Hiding::unclear;
    // How far along that way the camera, which is the origin, stands; planes between the bodies cross it
    // anywhere in the gap. Where they reach into each other a little, half-way through what they share.
    const double camera = -p.dot(way) / length;
    if (camera <= first.radius + std::min(0.0, 0.5 * gap)) return Hiding::by_first;
    if (camera >= first.radius + std::max(gap, 0.5 * gap)) return Hiding::by_second;
    return Hiding::none;  // between them
}

void sort_for_painting(std::span<std::unique_ptr<SeenObject>> objects) {
    std::stable_sort(objects.begin(), objects.end(),
                     [](const auto& a, const auto& b) { return a->distance() > b->distance(); });
    Order order(objects);
    if (!order.detours()) return;
    std::vector<std::unique_ptr<SeenObject>> sorted;
    for (const std::size_t i : order.run()) sorted.push_back(std::move(objects[i]));
    std::move(sorted.begin(), sorted.end(), objects.begin());
}

}  // namespace goalmouth
