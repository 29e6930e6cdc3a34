#include "core/detection/pairing.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <tuple>

namespace goalmouth {
namespace {

double nearest_end(const Eigen::Vector2d& p, const LineSegment& s) {
    return std::min((p - s.upper).norm(), (p - s.lower).norm());
}

bool plausible(const PairMeasures& m, double width_times_distance, const PairingParameters& parameters) {
    if (parameters.left_of && m.width <= 0.0) return false;
    const double width = std::abs(m.width);
    if (m.length < parameters.least_aspect * width) return false;
    if (m.lean > parameters.largest_lean) return false;
    if (parameters.farthest <= 0.0) return true;
    return width_times_distance >= parameters.nearest * width &&
           width_times_distance <= parameters.farthest * width;
}

}  // namespace

double PairMeasures::dissimilarity() const {
    const auto share = [](double value, double bound) { return bound > 0.0 ? value / bound : 1.0; };
    return 0.25 * (share(angle, angle_bound) + share(length_difference, length_bound) +
                   share(endpoint_distance, endpoint_bound) + share(support_difference, support_bound));
}

namespace {

/// Unit vector across the mean direction of two lines.
Eigen::Vector2d mean_normal(const LineSegment& left, const LineSegment& right) {
    Eigen::Vector2d other = right.line.normal;
    if (left.line.normal.dot(other) < 0.0) other = -other;
    return line_with_normal(left.line.normal + other, Eigen::Vector2d::Zero()).normal;
}

}  // namespace

double width_across(const LineSegment& left, const LineSegment& right) {
    const Eigen::Vector2d across = mean_normal(left, right);
    const Line across_axis = line_with_normal(across, Eigen::Vector2d::Zero());
    const Line cut = line_with_normal(across_axis.direction(), 0.5 * (left.middle() + right.middle()));
    const auto a = intersection(cut, left.line);
    const auto b = intersection(cut, right.line);
    if (!a || !b) return 0.0;
    return across.dot(*b - *a);
}

PairMeasures compare_edges(const EdgeLine& left, const EdgeLine& right, int image_width, int image_height,
                           double permissiveness) {
    const double l1 = left.segment.length();
    const double l2 = right.segment.length();
    PairMeasures m;
    m.angle = acute_angle(left.segment.line, right.segment.line);
    m.angle_bound = permissiveness * std::numbers::pi / 2.0;
    m.length_difference = std::abs(l1 - l2);
    m.length_bound = permissiveness * std::max(l1, l2);
    m.endpoint_distance = 0.5 * (nearest_end(left.segment.upper, right.segment) +
                                 nearest_end(left.segment.lower, right.segment));
    m.endpoint_bound = permissiveness * std::hypot(image_width, image_height);
    m.support_difference = std::abs(left.support - right.support);
    m.support_bound = permissiveness * std::max(left.support, right.support);
    m.width = width_across(left.segment, right.segment);
    m.length = 0.5 * (l1 + l2);
    m.lean = std::asin(std::min(1.0, std::abs(mean_normal(left.segment, right.segment).y())));
    return m;
}

std::pair<EdgeLine, EdgeLine> common_rows(const EdgeLine& left, const EdgeLine& right, int image_width,
                                          double margin) {
    const auto cut = [&](const LineSegment& s) {
        return std::min(s.upper.x(), s.lower.x()) < margin ||
               std::max(s.upper.x(), s.lower.x()) > image_width - 1 - margin;
    };
    const double top = std::max(left.segment.upper.y(), right.segment.upper.y());
    const double base = std::min(left.segment.lower.y(), right.segment.lower.y());
    if (base <= top || !(cut(left.segment) || cut(right.segment))) return {left, right};
    const auto clipped = [&](EdgeLine edge) {
        const double length = edge.segment.length();
        edge.segment.upper = {edge.segment.line.x_at(top).value_or(edge.segment.upper.x()), top};
        edge.segment.lower = {edge.segment.line.x_at(base).value_or(edge.segment.lower.x()), base};
        edge.support = static_cast<int>(std::lround(edge.support * edge.segment.length() / length));
        return edge;
    };
    return {clipped(left), clipped(right)};
}

double largest_hole(const LineSegment& left, const LineSegment& right, const Candidates& candidates) {
    std::vector<double> covered;
    return largest_hole(left, right, candidates, covered);
}

double largest_hole(const LineSegment& left, const LineSegment& right, const Candidates& candidates,
                    std::vector<double>& covered) {
    const double top = std::max(left.upper.y(), right.upper.y());
    const double base = std::min(left.lower.y(), right.lower.y());
    if (base <= top) return 1.0;
    covered.assign({top, base});
    for (const CandidateSegment& s : candidates.segments) {
        if (s.orientation != Orientation::horizontal || s.line < top || s.line > base) continue;
        const auto l = left.line.x_at(s.line);
        const auto r = right.line.x_at(s.line);
        if (!l || !r) continue;
        const double overlap = std::min(s.end + 0.5, *r) - std::max(s.start - 0.5, *l);
        if (overlap > 0.0 && overlap >= 0.5 * (*r - *l)) covered.push_back(s.line);
    }
    std::sort(covered.begin(), covered.end());
    double hole = 0.0;
    for (std::size_t i = 1; i < covered.size(); ++i) hole = std::max(hole, covered[i] - covered[i - 1]);
    return hole / (base - top);
}

const std::vector<EdgePair>& EdgePairing::pair(const std::vector<EdgeLine>& left,
                                               const std::vector<EdgeLine>& right,
                                               const Candidates& candidates, double width_times_distance) {
    acceptable_.clear();
    for (std::size_t i = 0; i < left.size(); ++i) {
        for (std::size_t j = 0; j < right.size(); ++j) {
            const auto [l, r] = common_rows(left[i], right[j], candidates.width, parameters_.cut_margin);
            const PairMeasures m =
                compare_edges(l, r, candidates.width, candidates.height, parameters_.permissiveness);
            if (!m.similar() || !plausible(m, width_times_distance, parameters_)) continue;
            if (parameters_.largest_hole < 1.0 &&
                largest_hole(l.segment, r.segment, candidates, covered_) > parameters_.largest_hole)
                continue;
            acceptable_.push_back({{i, j}, m.dissimilarity()});
        }
    }
    // Those as dissimilar as each other in the order they came in.
    std::sort(acceptable_.begin(), acceptable_.end(), [](const Scored& a, const Scored& b) {
        return std::tie(a.dissimilarity, a.pair.left, a.pair.right) <
               std::tie(b.dissimilarity, b.pair.left, b.pair.right);
    });

    pairs_.clear();
    for (const Scored& next : acceptable_) {
        const bool taken = std::any_of(pairs_.begin(), pairs_.end(), [&](const EdgePair& p) {
            return p.left == next.pair.left || p.right == next.pair.right;
        });
        if (!taken) pairs_.push_back(next.pair);
    }
    return pairs_;
}

std::vector<EdgePair> pair_edges(const std::vector<EdgeLine>& left, const std::vector<EdgeLine>& right,
                                 const Candidates& candidates, double width_times_distance,
                                 const PairingParameters& parameters) {
    return EdgePairing(parameters).pair(left, right, candidates, width_times_distance);
}

}  // namespace goalmouth
