#include "tools/evaluate/images_truth.h"

#include <array>
#include <cmath>
#include <utility>

namespace goalmouth {
namespace {

using Chosen = std::vector<std::optional<std::size_t>>;  // by outline: the goalpost

double square(double v) {
    return v * v;
}

/// In frame C, + left.
double bearing(const ReferencePost& post, const Intrinsics& camera) {
    const Eigen::Vector2d middle = 0.25 * (post.left_top + post.left_base + post.right_top + post.right_base);
    return -std::atan(normalised_from_pixel(camera, middle).x());
}

bool in_view(double bearing, const Intrinsics& camera) {
    const double row = camera.cy;
    const double left = -std::atan(normalised_from_pixel(camera, {-0.5, row}).x());
    const double right = -std::atan(normalised_from_pixel(camera, {camera.width - 0.5, row}).x());
    const double margin = placement_gate * placement_sigma;
    return bearing < left + margin && bearing > right - margin;
}

/// Tries everything: there are four goalposts.
class Assignment {
  public:
    using Costs = std::vector<std::array<std::optional<double>, 4>>;
    explicit Assignment(Costs costs) : costs_(std::move(costs)), now_(costs_.size()), best_(costs_.size()) {
        extend(0, 0.0);
    }
    const Chosen& best() const { return best_; }

  private:
    void extend(std::size_t outline, double cost) {
        if (outline == costs_.size()) {
            if (cost >= best_cost_) return;
            best_cost_ = cost;
            best_ = now_;
            return;
        }
        for (std::size_t post = 0; post < taken_.size(); ++post) {
            if (taken_[post] || !costs_[outline][post]) continue;
            taken_[post] = true;
            now_[outline] = post;
            extend(outline + 1, cost + *costs_[outline][post]);
            taken_[post] = false;
        }
        now_[outline].reset();
        extend(outline + 1, cost + square(placement_gate * placement_sigma));
    }

    Costs costs_;
    Chosen now_, best_;
    std::array<bool, 4> taken_{};
    double best_cost_ = HUGE_VAL;
};

}  // namespace

std::vector<std::optional<PlacedPost>> place_posts(std::span<const ReferencePost> outlines,
                                                   const Intrinsics& camera, const RobotPlace& place,
                                                   const Field& field) {
    const auto goalposts = field.posts();
    std::array<double, 4> expected{};
    for (std::size_t post = 0; post < goalposts.size(); ++post) {
        const Eigen::Vector2d way = goalposts[post] - place.feet.position();
        expected[post] = wrap_angle(std::atan2(way.y(), way.x()) - place.looks());
    }
    Assignment::Costs costs(outlines.size());
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        for (std::size_t post = 0; post < goalposts.size(); ++post) {
            const double off = wrap_angle(bearing(outlines[i], camera) - expected[post]);
            if (in_view(expected[post], camera) && std::abs(off) <= placement_gate * placement_sigma)
                costs[i][post] = square(off);
        }
    }
    const Chosen choice = Assignment(costs).best();
    std::vector<std::optional<PlacedPost>> placed(outlines.size());
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        if (!choice[i]) continue;
        placed[i] = {*choice[i], (goalposts[*choice[i]] - place.feet.position()).norm(),
                     wrap_angle(bearing(outlines[i], camera) - expected[*choice[i]])};
    }
    return placed;
}

}  // namespace goalmouth
