#include "core/refinement/goal_pairs.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace goalmouth {
namespace {

constexpr int n = distance_error::count;
using State = Eigen::Matrix<double, 5, 1>;  // D₁, β₁, D₂, β₂, γ
using StateCovariance = Eigen::Matrix<double, 5, 5>;

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Change of the angle between two middle planes with one post's errors.
DistanceGradient angle_change(const PostSilhouette& post, const Eigen::Vector3d& other, double angle) {
    DistanceGradient change = DistanceGradient::Zero();
    const double per_turn = -1.0 / std::sin(angle);
    using namespace distance_error;
    change[step + silhouette_part::swing] = per_turn * other.dot(post.ahead);
    change[step + silhouette_part::roll] = -per_turn * other.dot(post.up);
    change[outline_middle] = change[step + silhouette_part::swing];
    return change;
}

/// With a focal length told too long by a share, per that share.
double angle_focal_change(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    constexpr double share = 1e-4;
    const Eigen::Vector3d scale(1.0, 1.0, 1.0 - share);
    return (angle_between(a.cwiseProduct(scale), b.cwiseProduct(scale)) - angle_between(a, b)) / share;
}

struct Pair {
    State state;
    StateCovariance covariance;
};

Pair join(const GoalPairPost& first, const GoalPairPost& second, const Eigen::Matrix3d& vertical) {
    using namespace distance_error;
    Eigen::Matrix<double, 2 * n, 2 * n> errors = Eigen::Matrix<double, 2 * n, 2 * n>::Zero();
    errors.topLeftCorner<n, n>() = first.estimate.errors;
    errors.bottomRightCorner<n, n>() = second.estimate.errors;
    DistanceErrors both = DistanceErrors::Zero();
    both.block<4, 4>(step, step) = first.kept_lean * second.kept_lean.transpose() *
                                   first.silhouette.ahead.dot(vertical * second.silhouette.ahead);
    for (const int same : {camera_height, focal, diameter, goal_height})
        both(same, same) = first.estimate.errors(same, same);
    both.block<4, 1>(step, camera_height) = first.estimate.errors.block<4, 1>(step, camera_height);
    both.block<1, 4>(camera_height, step) = second.estimate.errors.block<1, 4>(camera_height, step);
    errors.topRightCorner<n, n>() = both;
    errors.bottomLeftCorner<n, n>() = both.transpose();

    const Eigen::Vector3d& one = first.silhouette.right;
    const Eigen::Vector3d& other = second.silhouette.right;
    const double angle = angle_between(one, other);
    Eigen::Matrix<double, 5, 2 * n> change = Eigen::Matrix<double, 5, 2 * n>::Zero();
    change.block<1, n>(0, 0) = first.estimate.distance_change;
    change.block<1, n>(1, 0) = first.estimate.bearing_change;
    change.block<1, n>(2, n) = second.estimate.distance_change;
    change.block<1, n>(3, n) = second.estimate.bearing_change;
    change.block<1, n>(4, 0) = angle_change(first.silhouette, other, angle);
    change.block<1, n>(4, n) = angle_change(second.silhouette, one, angle);
    change(4, focal) += angle_focal_change(one, other);
    Pair pair;
    pair.state << first.estimate.distance, first.estimate.bearing, second.estimate.distance,
        second.estimate.bearing, angle;
    pair.covariance = change * errors * change.transpose();
    return pair;
}

double apart(const State& x) {
    return std::sqrt(std::max(0.0, x[0] * x[0] + x[2] * x[2] - 2.0 * x[0] * x[2] * std::cos(x[4])));
}

Eigen::Matrix<double, 1, 5> apart_change(const State& x) {
    Eigen::Matrix<double, 1, 5> change = Eigen::Matrix<double, 1, 5>::Zero();
    const double c = std::cos(x[4]);
    change << x[0] - x[2] * c, 0.0, x[2] - x[0] * c, 0.0, x[0] * x[2] * std::sin(x[4]);
    return change / apart(x);
}

bool plausible(const Pair& pair, double width, double error) {
    constexpr double least_angle = 0.02;  // rad: a goal seen along its line tells nothing
    if (!(pair.state[4] > least_angle) || !(apart(pair.state) > 0.0)) return false;
    const Eigen::Matrix<double, 1, 5> h = apart_change(pair.state);
    const double known = h * pair.covariance * h.transpose();
    constexpr double gate = 3.0;      // sigmas
    constexpr double straight = 0.2;  // of the width: first order holds for no more
    const double off = apart(pair.state) - width;
    return known < straight * straight * width * width && off * off <= gate * gate * (known + error * error);
}

bool update(Pair& pair, double width, double error) {
    const State before = pair.state;
    Eigen::Matrix<double, 1, 5> h;
    State gain;
    for (int round = 0; round < 5; ++round) {
        h = apart_change(pair.state);
        const double variance = (h * pair.covariance * h.transpose())(0) + error * error;
        gain = pair.covariance * h.transpose() / variance;
        const double off = width - apart(pair.state) - h * (before - pair.state);
        pair.state = before + gain * off;
    }
    pair.covariance = (StateCovariance::Identity() - gain * h) * pair.covariance;
    pair.covariance = 0.5 * (pair.covariance + pair.covariance.transpose()).eval();
    return pair.state.allFinite() && pair.covariance.allFinite() && pair.state[0] > 0.0 &&
           pair.state[2] > 0.0;
}

GoalPairResult result_of(const Pair& pair, Eigen::Index at, std::size_t post, const PostEstimate& before) {
    GoalPairResult result;
    result.post = post;
    result.estimate = pair.state.segment<2>(at);
    result.covariance = pair.covariance.block<2, 2>(at, at);
    const double variance = before.covariance()(0, 0);
    const double information = 1.0 / result.covariance(0, 0) - 1.0 / variance;
    constexpr double worth_telling = 0.02;
    if (information * variance > worth_telling) {
        result.sigma = std::sqrt(1.0 / information);
        result.distance =
            (result.estimate[0] / result.covariance(0, 0) - before.distance / variance) / information;
    }
    return result;
}

}  // namespace

std::vector<GoalPairResult> pair_up(const std::vector<GoalPairPost>& posts, const Eigen::Matrix3d& vertical,
                                    double goal_width, double goal_error) {
    constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::vector<int> partners(posts.size(), 0);
    std::vector<std::size_t> partner(posts.size(), none);
    for (std::size_t i = 0; i < posts.size(); ++i) {
        for (std::size_t k = i + 1; k < posts.size(); ++k) {
            if (!plausible(join(posts[i], posts[k], vertical), goal_width, goal_error)) continue;
            ++partners[i], ++partners[k];
            partner[i] = k, partner[k] = i;
        }
    }
    std::vector<GoalPairResult> results;
    for (std::size_t i = 0; i < posts.size(); ++i) {
        const std::size_t k = partner[i];
        if (k == none || k < i || partners[i] != 1 || partners[k] != 1) continue;
        Pair pair = join(posts[i], posts[k], vertical);
        if (!update(pair, goal_width, goal_error)) continue;
        results.push_back(result_of(pair, 0, i, posts[i].estimate));
        results.push_back(result_of(pair, 2, k, posts[k].estimate));
    }
    return results;
}

}  // namespace goalmouth
