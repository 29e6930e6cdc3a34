#include "core/refinement/chroma_evidence.h"

#include "core/refinement/along_edges.h"
#include "core/refinement/whole_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace goalmouth {
namespace {

constexpr int most_rows = 64;
constexpr double reach = 8.0;  // px beside an edge: chroma's blur and its lag
// Of the post's luma, across an edge: where it is little, the post's shading is what luma shows there.
constexpr double least_step_share = 0.25;
constexpr double least_chroma = 16.0;
constexpr double least_inside = 3.0;  // px, to the post's middle

double mean_luma(const std::uint8_t* row, int width, double from, double to) {
    const int first = std::max(0, whole_above(std::min(from, to)));
    const int last = std::min(width - 1, whole_below(std::max(from, to)));
    int sum = 0;
    for (int x = first; x <= last; ++x) sum += row[2 * x];
    return last >= first ? static_cast<double>(sum) / (last - first + 1) : -1.0;
}

/// One row of an edge, added to its block.
void add_row(const std::uint8_t* row, int width, const EdgeRow& at, const Eigen::Vector2f& hue,
             double least_step, ChromaLag::Steps& steps) {
    const double outwards = at.outwards(), in = std::min(reach, at.inside);
    const double outer = mean_luma(row, width, at.edge + 0.5 * outwards * reach, at.edge + outwards * reach);
    const double inner = mean_luma(row, width, at.edge - 0.25 * outwards * in, at.edge - 0.5 * outwards * in);
    if (outer < 0.0 || inner < 0.0 || std::abs(inner - outer) < least_step) return;
    const int inwards = outwards > 0.0 ? -1 : 1;
    const int brighter = inner > outer ? inwards : -inwards;
    const double from = at.edge - (at.side == 0 ? reach : in), to = at.edge + (at.side == 0 ? in : reach);
    // Chroma's step from a pair to the next lies between the pixels 2 · pair + 1 and 2 · pair + 2; luma's,
    // over two pixels each, takes one more to either side.
    constexpr int margin = (ChromaLag::most + 3) / 2;  // pairs
    const int first = std::max(margin, whole_above(0.5 * (from - 1.5)));
    const int last = std::min(width / 2 - 2 - margin, whole_below(0.5 * (to - 1.5)));
    if (first > last) return;
    // Luma's steps where they go with the edge, backwards from the farthest that any lag asks for.
    constexpr int lags = 2 * ChromaLag::most + 1, most_pairs = static_cast<int>(reach) + 1;
    std::array<double, lags + 2 * most_pairs> lumas;
    const int farthest = 2 * last + 1 + ChromaLag::most;
    const int count = 2 * (last - first) + lags;
    for (int i = 0; i < count; ++i) {
        const std::uint8_t* q = row + 2 * (farthest - i);
        lumas[static_cast<std::size_t>(i)] = std::max(0, brighter * (q[4] + q[2] - q[0] - q[-2]));
    }
    for (int pair = first; pair <= last; ++pair) {
        const std::uint8_t* p = row + 4 * pair;
        const float chroma = static_cast<float>(inwards) * (hue.x() * static_cast<float>(p[5] - p[1]) +
                                                            hue.y() * static_cast<float>(p[7] - p[3]));
        if (!(chroma > 0.0F)) continue;
        const auto factor = static_cast<double>(chroma);
        const double* const luma = lumas.data() + 2 * (last - pair);
        for (std::size_t lag = 0; lag < steps.size(); ++lag) steps[lag] += factor * luma[lag];
    }
}

/// The lag of the greatest. Chroma comes in pairs of pixels, which makes more of lags of two px: steps
/// half-way between are interpolated. Then the top of a parabola.
std::optional<double> peak_of(const ChromaLag::Steps& steps) {
    constexpr std::size_t margin = 3;
    constexpr int most = ChromaLag::most - static_cast<int>(margin);
    std::array<double, 2 * most + 1> even;
    for (std::size_t i = 0; i < even.size(); ++i) {
        const double* at = &steps[i + margin];
        even[i] = at[0] + (9.0 * (at[-1] + at[1]) - (at[-3] + at[3])) / 16.0;
    }
    const auto top = std::max_element(even.begin(), even.end());
    if (!(*top > 0.0) || top == even.begin() || top == even.end() - 1) return std::nullopt;
    const double bend = 2.0 * top[0] - top[-1] - top[1];
    if (!(bend > 0.0)) return std::nullopt;
    return static_cast<double>(top - even.begin()) - most + 0.5 * (top[1] - top[-1]) / bend;
}

}  // namespace

ChromaLag& ChromaLag::operator+=(const ChromaLag& other) {
    for (std::size_t i = 0; i < steps_.size(); ++i)
        for (std::size_t k = 0; k < steps_[i].size(); ++k) steps_[i][k] += other.steps_[i][k];
    return *this;
}

std::optional<ChromaLag::Told> ChromaLag::told() const {
    Steps sum{};
    for (const Steps& steps : steps_)
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += steps[k];
    const auto lag = peak_of(sum);
    if (!lag) return std::nullopt;
    double squares = 0.0;  // jackknife
    for (const Steps& left_out : steps_) {
        Steps rest = sum;
        for (std::size_t k = 0; k < sum.size(); ++k) rest[k] -= left_out[k];
        const auto without = peak_of(rest);
        if (!without) return std::nullopt;
        squares += (*without - *lag) * (*without - *lag);
    }
    return Told{*lag, std::sqrt(squares * (blocks - 1.0) / blocks)};
}

ChromaEvidence& ChromaEvidence::operator+=(const ChromaEvidence& other) {
    for (std::size_t i = 0; i < sides_.size(); ++i) sides_[i] += other.sides_[i];
    return *this;
}

double ChromaEvidence::shift() const {
    const std::array<std::optional<ChromaLag::Told>, 2> told = {sides_[0].told(), sides_[1].told()};
    if (!told[0] || !told[1]) return 0.0;
    // px: what shading, or something beside a post, does to one side's lag, and what that leaves of both's.
    constexpr double of_one = 0.3, of_both = 0.1;
    constexpr double least = 0.3;              // px
    constexpr double sure = 4.0, alike = 1.5;  // sigmas
    double weights = 0.0, lag = 0.0, variance = 0.0;
    for (const auto& side : told) {
        const double weight = 1.0 / (side->sigma * side->sigma + of_one * of_one);
        weights += weight;
        lag += weight * side->lag;
        variance += weight * weight * (side->sigma * side->sigma + of_both * of_both);
    }
    lag /= weights;
    if (std::abs(lag) < least || std::abs(lag) < sure * std::sqrt(variance) / weights) return 0.0;
    const bool agreed = std::all_of(told.begin(), told.end(), [&](const auto& side) {
        return std::abs(side->lag - lag) <= alike * std::hypot(side->sigma, of_one);
    });
    return agreed ? lag : 0.0;
}

ChromaEvidence chroma_evidence(YuyvView image, const RoughOutline& outline, const PostColour& colour,
                               const Intrinsics& camera, const CoarseEdgeFinder::Edges& edges) {
    ChromaEvidence evidence;
    const Eigen::Vector2f chroma = colour.mean.tail<2>();
    if (!(chroma.norm() >= least_chroma)) return evidence;
    const Eigen::Vector2f hue = chroma.normalized();
    along_edges(outline, camera, edges, most_rows, [&](const EdgeRow& row) {
        if (!(row.inside > least_inside)) return;
        const int block = static_cast<int>(row.share * ChromaLag::blocks);
        add_row(image.row(row.y), image.width, row, hue,
                least_step_share * static_cast<double>(colour.mean.x()),
                evidence.side(row.side).block(block));
    });
    return evidence;
}

}  // namespace goalmouth
