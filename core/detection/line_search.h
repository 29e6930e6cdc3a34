#pragma once

#include "core/detection/edge_lines.h"
#include "core/detection/line_scoring.h"
#include "core/detection/ransac_parameters.h"
#include "core/geometry/line.h"
#include "core/random/random.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// Algorithm 2 of the paper for lines, fast: the same samples, consensus sets and lines, bit for bit, as
/// find_primitives() gives, which says what they are (primitive_ransac.h).
///
///   * The hypotheses lie one in each vector lane: a load of a point serves many, and counts need no sums
///     across lanes. The points that a model leaves are moved together.
///   * They are counted in whole numbers of 16 bits with a distance larger by all that rounding can do, which
///     bounds the support from above. Only a hypothesis whose bound beats the best one's support is counted
///     again in double precision as Line::distance() does it; mostly that is one of all.
///   * Samples, which depend on their number alone, are drawn many at once. Once all points agree, no more
///   are.
class LineSearch {
  public:
    explicit LineSearch(const RansacParameters& parameters) : parameters_(parameters) {}

    /// Valid until the next call. No heap allocation once warm.
    const std::vector<EdgeLine>& find(std::span<const Eigen::Vector2d> points, Random& random);

  private:
    struct Best {
        Line line;
        std::size_t support = 0;
        std::size_t attempt = std::numeric_limits<std::size_t>::max();
    };

    void load(std::span<const Eigen::Vector2d> points);
    Best best_hypothesis(Random& random);
    void draw(std::uint64_t key, std::size_t from, std::size_t count);
    std::size_t search_samples(std::size_t drawn, std::size_t needed, Best& best);
    bool try_sample(std::size_t i, std::size_t drawn, Best& best) const;
    void take(const Line& line);

    RansacParameters parameters_;
    std::vector<EdgeLine> found_;
    std::vector<double> consensus_x_, consensus_y_;
    // What no model has taken yet, the first `count_` of each:
    std::size_t count_ = 0;
    std::vector<double> x_, y_;
    std::vector<GridPoint> on_grid_, rounded_;
    Grid grid_;
    // The attempts in work:
    LineSamples samples_;
    std::array<std::uint64_t, LineSamples::most + 8> chosen_{};  // the samples' points: first + 2^32 · second
    std::array<std::uint32_t, LineSamples::most> support_{};
};

/// Up to M_max lines among edge points; each is the best supported one found among the points the former
/// left. A LineSearch used once.
std::vector<EdgeLine> find_lines(const std::vector<Eigen::Vector2d>& points,
                                 const RansacParameters& parameters, Random& random);

}  // namespace goalmouth
