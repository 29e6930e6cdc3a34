#include "core/refinement/coarse_edges.h"

#include "core/refinement/row_differences.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

constexpr int most_rows = 48;
constexpr std::size_t least_crossings = 5;

std::size_t place_of(OutlineSide side) {
    return side == OutlineSide::left ? 0 : 1;
}

/// Pairs of two rows, from inside a post outwards.
class Walk {
  public:
    /// That between `from` and `to` are asked for most.
    Walk(YuyvView image, int row, const PostColour& colour, int from, int to, RowDifferences& differences)
        : upper_(image.row(row), image.width / 2, colour.response),
          lower_(image.row(std::min(row + 1, image.height - 1)), image.width / 2, colour.response),
          pairs_(image.width / 2),
          colour_(colour),
          known_(differences) {
        if (colour.response != CameraResponse::linear) return;
        first_ = std::clamp(std::min(from, to) - 1, 0, pairs_);
        const int last = std::min(
            {std::max(from, to) + 1, pairs_ - 1, first_ + static_cast<int>(RowDifferences::most) - 1});
        count_ = std::max(0, last - first_ + 1);
        row_differences(image.row(row) + 4 * first_,
                        image.row(std::min(row + 1, image.height - 1)) + 4 * first_,
                        static_cast<std::size_t>(count_), colour, differences);
    }

    bool inside(int pair) const { return pair >= 0 && pair < pairs_; }
    Eigen::Vector3f offset(int pair) const {
        const PairColour z = 0.5F * (upper_[pair] + lower_[pair]);
        return z - colour_.mean;
    }
    float difference(int pair) const {
        if (pair >= first_ && pair < first_ + count_)
            return known_.difference[static_cast<std::size_t>(pair - first_)];
        const Eigen::Vector3f e = offset(pair);
        return e.dot(colour_.contrast * e);
    }

  private:
    PairRow upper_, lower_;
    int pairs_;
    const PostColour& colour_;
    const RowDifferences& known_;
    int first_ = 0, count_ = 0;
};

/// Column [px] where the post's colour ends, on the way from pair `from` to pair `to`.
std::optional<double> end_of_colour(const Walk& walk, const PostColour& colour, int from, int to,
                                    float least_contrast) {
    const int step = to < from ? -1 : 1;
    const float alike = 10.0F * colour.spread;
    int pair = from;
    if (!walk.inside(pair)) return std::nullopt;
    // An occluder may lie over the middle and leave the edge free.
    while (pair != to && walk.inside(pair) && walk.difference(pair) > alike) pair += step;
    // Two pairs after one another.
    for (bool differs = false;; pair += step) {
        if (pair == to + step || !walk.inside(pair) || !walk.inside(pair + 2 * step)) return std::nullopt;
        const bool differed = differs;
        differs = walk.difference(pair) > alike;
        if (differs && differed) break;
    }
    pair -= step;
    const Eigen::Vector3f beyond = 0.5F * (walk.offset(pair + 2 * step) + walk.offset(pair + 3 * step));
    Eigen::Vector3f weights = colour.contrast * beyond;
    if (beyond.dot(weights) < 2.0F * least_contrast * least_contrast) {
        // Black differs by its brightness alone, which is enough for half a pixel.
        if (colour.mean[0] + beyond[0] > colour.darkest) return std::nullopt;
        weights = {beyond[0], 0.0F, 0.0F};
    }
    const float strength = beyond.dot(weights);
    float before = 0.0F;
    for (int at = pair - step, n = 0; n < 4; at += step, ++n) {
        if (!walk.inside(at)) return std::nullopt;
        const float share = weights.dot(walk.offset(at)) / strength;
        if (share >= 0.5F) {
            const double way = n == 0 ? 0.0 : (0.5F - before) / (share - before);
            return 2.0 * (at - step) + 0.5 + 2.0 * step * way;
        }
        before = share;
    }
    return std::nullopt;
}

/// The part of a direction that lies in a plane.
Eigen::Vector3d along(const Eigen::Vector3d& direction, const Eigen::Vector3d& plane) {
    return (direction - direction.dot(plane) * plane).normalized();
}

/// How well crossings lie on u = p + q·v, each at most 1.
template <class Crossings>
double agreement(const Crossings& crossings, double p, double q, double per_near) {
    double sum = 0.0;
    for (const EdgeCrossing& c : crossings) {
        const double miss = (c.u - p - q * c.v) * per_near;
        sum += c.weight * std::max(0.0, 1.0 - miss * miss);
    }
    return sum;
}

}  // namespace

void CoarseEdgeFinder::collect(YuyvView image, const RoughOutline& outline, const PostColour& colour,
                               PixelRays& rays, const CoarseSearch& search, OutlineSide side) {
    auto& crossings = crossings_[place_of(side)];
    crossings.clear();
    const int rows = outline.last_row - outline.first_row + 1;
    const int lines = std::min(most_rows, rows);
    for (int i = 0; i < lines; ++i) {
        const int y = outline.first_row + static_cast<int>((2LL * i + 1) * rows / (2LL * lines));
        const double left = outline.left(y), right = outline.right(y);
        constexpr double blur = 4.0;  // px, to start clear of the edge and to see what comes behind
        const double inwards = std::min(search.tolerance + blur, 0.5 * (right - left));
        const bool is_left = side == OutlineSide::left;
        const double start = is_left ? left + inwards : right - inwards;
        const double end = is_left ? left - search.tolerance - blur : right + search.tolerance + blur;
        const int from = PairRow::pair_at(start), to = PairRow::pair_at(end);
        const Walk walk(image, y, colour, from, to, differences_);
        const auto x = end_of_colour(walk, colour, from, to, search.least_contrast);
        if (!x) continue;
        const double row = std::min(y + 0.5, image.height - 1.0);
        const RowRay ray = rays.at(*x, row);
        const double off = (*x - (is_left ? left : right)) / (search.tolerance + 1.0);
        if (std::abs(off) > 1.0) continue;
        crossings.push_back({ray.ray.x(), ray.ray.y(), 1.0 - 0.5 * off * off});
    }
}

std::optional<CoarseEdge> CoarseEdgeFinder::line(OutlineSide side, double near) const {
    const auto& crossings = crossings_[place_of(side)];
    const std::size_t n = crossings.size();
    if (n < least_crossings) return std::nullopt;
    constexpr double most_slope = 2.0;
    double best = 0.0, best_p = 0.0, best_q = 0.0;
    const std::size_t least_gap = std::max<std::size_t>(1, n / 4);
    const std::size_t gap_step = std::max<std::size_t>(1, n / 10);
    const std::size_t start_step = std::max<std::size_t>(1, n / 20);
    for (std::size_t gap = least_gap; gap < n; gap += gap_step) {
        for (std::size_t i = 0; i + gap < n; i += start_step) {
            const EdgeCrossing& a = crossings[i];
            const EdgeCrossing& b = crossings[i + gap];
            const double q = (b.u - a.u) / (b.v - a.v);
            if (!(std::abs(q) < most_slope)) continue;
            const double p = a.u - q * a.v;
            const double score = agreement(crossings, p, q, 1.0 / near);
            if (score > best) best = score, best_p = p, best_q = q;
        }
    }
    if (!(best > 0.0)) return std::nullopt;
    CoarseEdge edge;
    edge.crossings = static_cast<int>(n);
    for (int round = 0; round < 2; ++round) {
        double w = 0.0, v = 0.0, u = 0.0, vv = 0.0, uv = 0.0;
        edge.agreeing = 0;
        for (const EdgeCrossing& c : crossings) {
            if (std::abs(c.u - best_p - best_q * c.v) > near) continue;
            ++edge.agreeing;
            w += 1.0, v += c.v, u += c.u, vv += c.v * c.v, uv += c.u * c.v;
        }
        const double spread = vv - v * v / std::max(w, 1.0);
        if (edge.agreeing < static_cast<int>(least_crossings) || !(spread > 0.0)) return std::nullopt;
        best_q = (uv - u * v / w) / spread;
        best_p = (u - best_q * v) / w;
    }
    const double sign = side == OutlineSide::left ? 1.0 : -1.0;
    edge.plane = sign * Eigen::Vector3d(1.0, -best_q, -best_p).normalized();
    return edge;
}

std::optional<CoarseEdge> CoarseEdgeFinder::line_along(OutlineSide side, double near,
                                                       const Eigen::Vector3d& axis) const {
    const auto& crossings = crossings_[place_of(side)];
    if (crossings.size() < least_crossings || std::abs(axis.y()) < 1e-3) return std::nullopt;
    // n = (1, −q, −p) contains the axis: q = (a_x − p·a_z) / a_y.
    const double slope = axis.x() / axis.y(), turn = axis.z() / axis.y();
    double best = 0.0, best_p = 0.0;
    for (const EdgeCrossing& c : crossings) {
        const double p = (c.u - c.v * slope) / (1.0 - c.v * turn);
        const double score = agreement(crossings, p, slope - p * turn, 1.0 / near);
        if (score > best) best = score, best_p = p;
    }
    CoarseEdge edge;
    edge.crossings = static_cast<int>(crossings.size());
    const double q = slope - best_p * turn;
    for (const EdgeCrossing& c : crossings) edge.agreeing += std::abs(c.u - best_p - q * c.v) <= near ? 1 : 0;
    if (edge.agreeing < static_cast<int>(least_crossings)) return std::nullopt;
    const double sign = side == OutlineSide::left ? 1.0 : -1.0;
    edge.plane = sign * Eigen::Vector3d(1.0, -q, -best_p).normalized();
    return edge;
}

double CoarseEdgeFinder::rival_of(const CoarseEdge& edge, OutlineSide side, double near,
                                  const Eigen::Vector3d& axis) const {
    const auto& crossings = crossings_[place_of(side)];
    if (std::abs(axis.y()) < 1e-3) return 0.0;
    const double slope = axis.x() / axis.y(), turn = axis.z() / axis.y();
    const double own_p = -edge.plane.z() / edge.plane.x(), own_q = -edge.plane.y() / edge.plane.x();
    rivals_.clear();
    double own = 0.0;
    for (const EdgeCrossing& c : crossings) {
        const double miss = std::abs(c.u - own_p - own_q * c.v);
        if (miss < near) own += 1.0;
        if (miss > 1.5 * near) rivals_.push_back((c.u - c.v * slope) / (1.0 - c.v * turn));
    }
    // The most of them within as narrow a band.
    std::sort(rivals_.begin(), rivals_.end());
    std::size_t most = 0;
    for (std::size_t first = 0, last = 0; last < rivals_.size(); ++last) {
        while (rivals_[last] - rivals_[first] > 2.0 * near) ++first;
        most = std::max(most, last - first + 1);
    }
    return static_cast<double>(most) / std::max(own, 1.0);
}

CoarseEdgeFinder::Edges CoarseEdgeFinder::find(YuyvView image, const RoughOutline& outline,
                                               const PostColour& colour, const Intrinsics& camera,
                                               const CoarseSearch& search) {
    PixelRays rays(camera);
    constexpr double near_px = 1.5;
    const double near = near_px / camera.fx;
    Edges edges;
    for (const OutlineSide side : {OutlineSide::left, OutlineSide::right}) {
        collect(image, outline, colour, rays, search, side);
        edges[place_of(side)] = line(side, near);
    }
    if (edges[0] && edges[1]) {
        const PostSilhouette both = silhouette_between(edges[0]->plane, edges[1]->plane, search.up);
        const double miss = std::abs(0.5 * (edges[0]->plane + edges[1]->plane).dot(both.up));
        const double length = (outline.last_row - outline.first_row) / camera.fy;
        const double allowed = 4.0 * search.lean_sigma * std::sin(std::abs(both.half_angle)) + near / length;
        if (miss > allowed || both.half_angle <= 0.0) {
            const OutlineSide weak =
                edges[0]->agreeing < edges[1]->agreeing ? OutlineSide::left : OutlineSide::right;
            const Eigen::Vector3d strong_plane = edges[1 - place_of(weak)]->plane;
            edges[place_of(weak)] = line_along(weak, near, along(search.up, strong_plane));
        }
    }
    for (const OutlineSide side : {OutlineSide::left, OutlineSide::right}) {
        auto& edge = edges[place_of(side)];
        if (edge) edge->rival = rival_of(*edge, side, near, along(search.up, edge->plane));
    }
    return edges;
}

}  // namespace goalmouth
