#include "core/detection/upright_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

namespace goalmouth {
namespace {

constexpr double least_lean_sigma = 1e-3;  // rad
constexpr double common_lean =
    2.0 / 3.0;                          // of a lean's sigma: what the camera does to all posts of a picture
constexpr double goal_evidence = 10.0;  // of two posts that stand as a goal's do: five rows with both edges
constexpr double width_doubt = 0.1;     // sigma of a goal's width, as a share of it
constexpr double edge_noise = 0.7;      // px, of a post's width

/// How far from the other's direction the line of sight turns one's roll into pitch.
double turn(const UprightPost& a, const UprightPost& b) {
    return std::sin(std::abs(a.edges.middle(0.0) - b.edges.middle(0.0)));
}

}  // namespace

bool UprightPairs::go_together(const UprightPost& a, const UprightPost& b, const UprightDoubt& doubt) const {
    constexpr double sigmas = 3.0;
    if (std::abs(a.edges.roll - b.edges.roll) >
        sigmas * (std::numbers::sqrt2 * std::max(least_lean_sigma, lean_sigma_) +
                  turn(a, b) * doubt.attitude_sigma))
        return false;
    const double top = std::min(a.evidence.first_slope, b.evidence.first_slope);
    const double base = std::max(a.evidence.last_slope, b.evidence.last_slope);
    if (top < base) return true;  // one above the other
    const double a_width = a.edges.right - a.edges.left, b_width = b.edges.right - b.edges.left;
    for (int k = 0; k <= 4; ++k) {
        const double slope = base + 0.25 * k * (top - base);
        const double roll = (a.edges.roll - b.edges.roll) * slope;
        const double left = a.edges.left - b.edges.left + roll;
        const double right = a.edges.right - b.edges.right + roll;
        if (std::abs(left) < 2.0 * doubt.tolerance || std::abs(right) < 2.0 * doubt.tolerance) return false;
        const double overlap = std::min(right, 0.0) + b_width - std::max(left, 0.0);
        constexpr double most = 0.25;  // of the narrower one's width
        if (overlap > most * std::min(a_width, b_width)) return false;
    }
    return true;
}

/// What their leans cost that the camera does not explain.
double UprightPairs::lean_apart(const UprightPost& a, const UprightPost& b, const UprightDoubt& doubt) const {
    const double own = std::max(least_lean_sigma, (1.0 - common_lean) * lean_sigma_);
    return cost_of_error(a.edges.roll - b.edges.roll, std::hypot(own, turn(a, b) * doubt.attitude_sigma));
}

double UprightPairs::of_one_goal(const UprightPost& a, const UprightPost& b,
                                 const UprightDoubt& doubt) const {
    const auto place = [&](const UprightPost& post) {
        const double azimuth = post.edges.middle(0.0);
        return Eigen::Vector2d(size_.radius / std::sin(post.edges.half_angle()) *
                               Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth)));
    };
    const Eigen::Vector2d at_a = place(a), at_b = place(b), between = at_b - at_a;
    const double apart = between.norm();
    if (!(apart > 0.0)) return 0.0;
    // What an error of the post's width does to its distance, and that to how far they are apart.
    const auto sigma = [&](const Eigen::Vector2d& at) {
        return std::abs(between.dot(at)) / apart * at.norm() / (2.0 * size_.radius) * edge_noise *
               doubt.pixel;
    };
    const double error =
        (apart - goal_width_) / std::hypot(width_doubt * goal_width_, sigma(at_a), sigma(at_b));
    return goal_evidence * std::exp(-0.5 * error * error);
}

std::optional<UprightPairs::Pair> UprightPairs::best(std::span<const UprightPost> posts,
                                                     const UprightDoubt& doubt) const {
    std::optional<Pair> best;
    double most = posts.empty() ? 0.0 : posts[0].evidence.score;
    for (std::size_t i = 0; i < posts.size(); ++i) {
        for (std::size_t j = i + 1; j < posts.size(); ++j) {
            const double alone = posts[i].evidence.score + posts[j].evidence.score;
            if (alone + goal_evidence <= most) break;  // those after score less
            const double together =
                alone + of_one_goal(posts[i], posts[j], doubt) - lean_apart(posts[i], posts[j], doubt);
            if (together <= most || !go_together(posts[i], posts[j], doubt)) continue;
            most = together;
            best = Pair{i, j};
        }
    }
    return best;
}

}  // namespace goalmouth
