#include "core/localisation/sensor_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goalmouth {
namespace {

constexpr std::size_t post_count = 4;
constexpr std::size_t set_count = 1U << post_count;

/// What a pose expects to see of one post.
struct Expected {
    double azimuth;
    double inverse_distance;
};

using AllExpected = std::array<Expected, post_count>;

AllExpected expected_at(const Pose2& pose, const FrameObservation& frame,
                        const std::array<Eigen::Vector2d, post_count>& posts) {
    AllExpected expected;
    const Eigen::Vector2d camera = transform(pose, frame.camera);
    for (std::size_t k = 0; k < post_count; ++k) {
        const Eigen::Vector2d d = posts[k] - camera;
        // A camera inside a post is closer than any measurement: the bound only keeps the number finite.
        expected[k] = {std::atan2(d.y(), d.x()) - pose.theta, 1.0 / std::max(0.02, d.norm())};
    }
    return expected;
}

double density(const PostObservation& z, const Expected& h) {
    const double da = wrap_angle(z.azimuth - h.azimuth);
    const double caa = z.covariance(0, 0);
    if (!z.has_distance) {
        return std::exp(-0.5 * da * da / caa) / std::sqrt(2.0 * std::numbers::pi * caa);
    }
    const double di = z.inverse_distance - h.inverse_distance;
    const double cai = z.covariance(0, 1);
    const double cii = z.covariance(1, 1);
    const double determinant = caa * cii - cai * cai;
    const double square = (cii * da * da - 2.0 * cai * da * di + caa * di * di) / determinant;
    return std::exp(-0.5 * square) / (2.0 * std::numbers::pi * std::sqrt(determinant));
}

/// An observation taken for one of the posts: ln of its factor without the common error, and its part in the
/// sums the common error is integrated with; residual / variance is 0 where it has none.
struct Match {
    double log = 0.0;
    double residual_by_variance = 0.0;
};

double log_normal(double square, double variance) {
    return -0.5 * (square / variance + std::log(2.0 * std::numbers::pi * variance));
}

/// What is left of an azimuth's variance without the common error and given the inverse distance.
double own_variance(const PostObservation& z) {
    double v = z.covariance(0, 0) - z.common_azimuth_variance;
    if (z.has_distance) v -= z.covariance(0, 1) * z.covariance(0, 1) / z.covariance(1, 1);
    return std::max(v, 1e-9);
}

Match match_of(const PostObservation& z, const Expected& h) {
    const double v = own_variance(z);
    double residual = wrap_angle(z.azimuth - h.azimuth);
    Match match;
    if (z.has_distance) {
        const double di = z.inverse_distance - h.inverse_distance;
        residual -= z.covariance(0, 1) / z.covariance(1, 1) * di;
        match.log += log_normal(di * di, z.covariance(1, 1));
    }
    match.log += log_normal(residual * residual, v);
    if (z.common_azimuth_variance > 0.0) match.residual_by_variance = residual / v;
    return match;
}

/// Sums over all one-to-one assignments of observations to posts or to clutter.
struct AssignmentSum {
    std::size_t observations = 0;
    std::array<double, SensorModel::most_observations> log_clutter{};
    std::array<std::array<Match, post_count>, SensorModel::most_observations> match{};
    /// By the set of observations that are taken for posts: s / (1 + s S_0), and ½ ln(1 + s S_0).
    std::array<double, 1U << SensorModel::most_observations> gain{};
    std::array<double, 1U << SensorModel::most_observations> half_log{};

    double total = 0.0;
    std::array<double, SensorModel::most_observations> explained{};

    void add(std::size_t i, unsigned posts_taken, unsigned explained_set, double log, double sum) {
        if (i == observations) {
            const double weight =
                std::exp(log + 0.5 * gain[explained_set] * sum * sum - half_log[explained_set]);
            total += weight;
            for (std::size_t j = 0; j < observations; ++j) {
                if ((explained_set & (1U << j)) != 0) explained[j] += weight;
            }
            return;
        }
        add(i + 1, posts_taken, explained_set, log + log_clutter[i], sum);
        for (std::size_t k = 0; k < post_count; ++k) {
            if ((posts_taken & (1U << k)) != 0) continue;
            add(i + 1, posts_taken | (1U << k), explained_set | (1U << i), log + match[i][k].log,
                sum + match[i][k].residual_by_variance);
        }
    }
};

}  // namespace

SensorModel::SensorModel(const Field& field, const SensorModelParameters& parameters)
    : parameters_(parameters),
      posts_(field.posts()),
      carpet_x_(field.length / 2.0 + field.border_strip),
      carpet_y_(field.width / 2.0 + field.border_strip) {}

bool SensorModel::is_side(std::size_t post, PostSide side) {
    if (side == PostSide::unknown) return true;
    const bool left = post == 1 || post == 2;
    return left == (side == PostSide::left);
}

SensorModel::Likelihood SensorModel::likelihood(const Pose2& pose, const FrameObservation& frame) const {
    const std::size_t m = std::min(frame.posts.size(), most_observations);
    Likelihood result;
    if (m == 0) return result;
    if (std::any_of(frame.posts.begin(), frame.posts.begin() + static_cast<std::ptrdiff_t>(m),
                    [](const PostObservation& z) { return z.common_azimuth_variance > 0.0; })) {
        return likelihood_with_common_error(pose, frame);
    }

    const AllExpected expected = expected_at(pose, frame, posts_);

    // forward[i][S]: sum over assignments of the first i observations that take exactly the posts of S.
    std::array<std::array<double, set_count>, most_observations + 1> forward;
    std::array<std::array<double, post_count>, most_observations> match;
    std::array<double, most_observations> clutter;
    forward[0].fill(0.0);
    forward[0][0] = 1.0;
    for (std::size_t i = 0; i < m; ++i) {
        const PostObservation& z = frame.posts[i];
        clutter[i] = parameters_.clutter_share / parameters_.clutter_azimuth_range;
        if (z.has_distance) clutter[i] /= parameters_.clutter_inverse_distance_range;
        const double wrong = parameters_.wrong_side_share;
        for (std::size_t k = 0; k < post_count; ++k) {
            const double side = z.side == PostSide::unknown ? 0.5 : is_side(k, z.side) ? 1.0 - wrong : wrong;
            match[i][k] = (1.0 - parameters_.clutter_share) * side * density(z, expected[k]) / post_count;
        }
        forward[i + 1].fill(0.0);
        for (std::size_t set = 0; set < set_count; ++set) {
            const double sum = forward[i][set];
            if (sum == 0.0) continue;
            forward[i + 1][set] += sum * clutter[i];
            for (std::size_t k = 0; k < post_count; ++k) {
                if ((set & (1U << k)) == 0) forward[i + 1][set | (1U << k)] += sum * match[i][k];
            }
        }
    }
    double total = 0.0;
    for (const double sum : forward[m]) total += sum;

    // backward[S]: sum over assignments of the observations from i on that leave out the posts of S.
    std::array<double, set_count> backward;
    backward.fill(1.0);
    double explained = 0.0;
    for (std::size_t i = m; i-- > 0;) {
        double as_clutter = 0.0;
        std::array<double, set_count> before;
        for (std::size_t set = 0; set < set_count; ++set) {
            as_clutter += forward[i][set] * clutter[i] * backward[set];
            before[set] = clutter[i] * backward[set];
            for (std::size_t k = 0; k < post_count; ++k) {
                if ((set & (1U << k)) == 0) before[set] += match[i][k] * backward[set | (1U << k)];
            }
        }
        backward = before;
        const double share = std::clamp(1.0 - as_clutter / total, 0.0, 1.0);
        explained += share / static_cast<double>(m);
        result.explained_each[i] = share;
    }
    result.log = std::log(total);
    result.explained = explained;
    return result;
}

SensorModel::Likelihood SensorModel::likelihood_with_common_error(const Pose2& pose,
                                                                  const FrameObservation& frame) const {
    const AllExpected expected = expected_at(pose, frame, posts_);
    AssignmentSum sum;
    sum.observations = std::min(frame.posts.size(), most_observations);
    double common = 0.0;
    for (std::size_t i = 0; i < sum.observations; ++i) {
        const PostObservation& z = frame.posts[i];
        common = std::max(common, z.common_azimuth_variance);
        double clutter = parameters_.clutter_share / parameters_.clutter_azimuth_range;
        if (z.has_distance) clutter /= parameters_.clutter_inverse_distance_range;
        sum.log_clutter[i] = std::log(clutter);
        const double wrong = parameters_.wrong_side_share;
        for (std::size_t k = 0; k < post_count; ++k) {
            const double side = z.side == PostSide::unknown ? 0.5 : is_side(k, z.side) ? 1.0 - wrong : wrong;
            sum.match[i][k] = match_of(z, expected[k]);
            sum.match[i][k].log += std::log((1.0 - parameters_.clutter_share) * side / post_count);
        }
    }
    for (unsigned set = 0; set < (1U << sum.observations); ++set) {
        double s0 = 0.0;
        for (std::size_t i = 0; i < sum.observations; ++i) {
            if ((set & (1U << i)) != 0 && frame.posts[i].common_azimuth_variance > 0.0)
                s0 += 1.0 / own_variance(frame.posts[i]);
        }
        sum.gain[set] = common / (1.0 + common * s0);
        sum.half_log[set] = 0.5 * std::log1p(common * s0);
    }
    sum.add(0, 0, 0, 0.0, 0.0);

    Likelihood result;
    result.log = std::log(sum.total);
    result.explained = 0.0;
    for (std::size_t i = 0; i < sum.observations; ++i) {
        result.explained_each[i] = std::clamp(sum.explained[i] / sum.total, 0.0, 1.0);
        result.explained += result.explained_each[i] / static_cast<double>(sum.observations);
    }
    return result;
}

double SensorModel::log_place(const Pose2& pose) const {
    const double dx = std::max(0.0, std::abs(pose.x) - carpet_x_) / parameters_.off_field_sigma;
    const double dy = std::max(0.0, std::abs(pose.y) - carpet_y_) / parameters_.off_field_sigma;
    return -0.5 * (dx * dx + dy * dy);
}

double SensorModel::news(double seconds) const {
    if (!(parameters_.correlation_time > 0.0)) return 1.0;
    return std::clamp(seconds / (2.0 * parameters_.correlation_time), 0.0, 1.0);
}

}  // namespace goalmouth
