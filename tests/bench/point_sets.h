#pragma once

#include "core/detection/edge_lines.h"
#include "tests/bench/contender.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace goalmouth::bench {

/// Numbers of points for which RANSAC is timed; the acceptance asks for those up to largest_judged.
inline constexpr std::size_t point_counts[] = {50, 100, 200, 500, 1000};
inline constexpr std::size_t largest_judged = 500;

/// Edge points as two posts of a two-megapixel picture give them: 45 % along one upright edge and 25 % along
/// another, both with noise of half a pixel, 10 % along something short, 20 % anywhere.
std::vector<Eigen::Vector2d> edge_point_set(std::size_t points, std::uint64_t seed);

/// Bit by bit the same lines with the same support.
bool same_lines(const std::vector<EdgeLine>& a, const std::vector<EdgeLine>& b);

/// Ours and the literal Algorithm 2 on sets of so many points.
struct PointRow {
    std::size_t points = 0;
    Timing ours;
    Timing literal;
    bool same_consensus = false;  // on every set
    double lines = 0.0;           // found, mean

    double ratio() const { return ours.median / literal.median; }
};

struct PointOptions {
    std::uint64_t seed = 1;
    std::size_t repetitions = 1;
    std::function<bool()> stop;
    std::function<void()> step;
};

/// How often run_point_sets steps.
std::size_t point_steps(const PointOptions& options);

/// One row for each of point_counts; nothing where it was stopped.
std::vector<PointRow> run_point_sets(const PointOptions& options);

}  // namespace goalmouth::bench
