#include "core/refinement/run_ends.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace goalmouth {
namespace {

constexpr float unlike = 20.0F;  // eᵀMe of a pair that is not of the post's colour
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A row's pairs as the post's colour or not.
class ColourRow {
  public:
    ColourRow(YuyvView image, int y, const PostColour& colour)
        : pairs_(image.width / 2), row_(image.row(y), pairs_, colour.response), colour_(colour) {}

    bool holds(int pair) const { return pair >= 0 && pair < pairs_; }
    bool shows(int pair) const {
        return holds(pair) && colour_.difference(row_[pair]) <= unlike * colour_.spread;
    }

  private:
    int pairs_;
    PairRow row_;
    const PostColour& colour_;
};

/// Of the ends that lie between two distances from the edge.
RunEnds::Place place_between(const std::vector<RunEnd>& rows, double from, double to, double spread) {
    std::vector<double> ends;
    for (const RunEnd& row : rows)
        if (row.beyond > from && row.beyond < to) ends.push_back(row.beyond);
    std::sort(ends.begin(), ends.end());
    RunEnds::Place place;
    std::size_t first = 0;
    for (std::size_t last = 0; last < ends.size(); ++last) {
        while (ends[last] - ends[first] > 2.0 * spread) ++first;
        const int rows_here = static_cast<int>(last - first) + 1;
        if (rows_here > place.rows) place = {ends[(first + last) / 2], rows_here};
    }
    return place;
}

}  // namespace

bool RunEnds::ends_here(const RunEnd& row) const {
    return std::abs(row.beyond) <= tolerance;
}

int RunEnds::here() const {
    return static_cast<int>(
        std::count_if(rows.begin(), rows.end(), [&](const RunEnd& row) { return ends_here(row); }));
}

RunEnds::Place RunEnds::inside() const {
    return place_between(rows, -infinity, -tolerance, spread);
}

RunEnds::Place RunEnds::outside() const {
    return place_between(rows, tolerance, near_by, spread);
}

RunEnds::Place RunEnds::far_outside() const {
    return place_between(rows, near_by, infinity, spread);
}

std::array<RunEnds, 2> run_ends(YuyvView image, const PostSilhouette& post, const PostColour& colour,
                                const Intrinsics& camera, const PostExtent& extent, double blur) {
    constexpr int most_rows = 100;
    constexpr double near_by = 6.0;  // px, and a width: how far outside an edge
    constexpr double widths_beyond = 4.0;
    // From one edge: where a row may show the post.
    constexpr std::array<double, 5> depths = {0.3, 0.4, 0.5, 0.6, 0.7};
    const std::array<Eigen::Vector3d, 2> planes = {post.plane(OutlineSide::left),
                                                   post.plane(OutlineSide::right)};
    const int seen = extent.last_edge_row - extent.first_edge_row + 1;
    const int last_row = std::min(image.height - 1, extent.last_edge_row + seen);
    int last_shown = extent.last_edge_row;
    const int step = std::max(1, seen / most_rows);
    const int lost = std::max(4, 2 * step);  // px without the post's colour: it has ended
    const auto centre = project(camera, post.ahead);
    PixelRays rays(camera);
    std::array<double, 2> edge{};
    edge.fill(centre ? centre->x() : camera.cx);
    std::array<RunEnds, 2> ends;
    double widths = 0.0, rows = 0.0;
    for (int y = extent.first_edge_row; y <= last_row && y <= last_shown + lost; y += step) {
        for (std::size_t side = 0; side < 2; ++side)
            edge[side] = rays.crossing(planes[side], edge[side], y).x;
        const double width = edge[1] - edge[0];
        constexpr double far = 1e5;  // px
        if (!(width > 1.0 && std::abs(edge[0]) < far && std::abs(edge[1]) < far)) return {};
        widths += width;
        rows += 1.0;
        const ColourRow row(image, y, colour);
        for (std::size_t side = 0; side < 2; ++side) {
            const int outwards = side == 0 ? -1 : 1;
            const auto depth = std::find_if(depths.begin(), depths.end(), [&](double share) {
                return row.shows(PairRow::pair_at(edge[side] - outwards * share * width));
            });
            if (depth == depths.end()) continue;
            last_shown = std::max(last_shown, y);
            const int last = PairRow::pair_at(edge[side] + outwards * (near_by + widths_beyond * width));
            // In strides as long as the post's colour goes on, then pair by pair. What is narrower than a
            // stride, a twelfth of the post, does not end it.
            int pair = PairRow::pair_at(edge[side] - outwards * *depth * width);
            for (int stride = std::max(1, static_cast<int>(width / 24.0)); stride > 0; stride /= 2)
                while (outwards * (last - pair) >= stride && row.shows(pair + outwards * stride))
                    pair += outwards * stride;
            // Between the last pair and the next; the colour is left before half of it is another's.
            if (pair == last || !row.holds(pair + outwards)) continue;
            const double end = 2.0 * pair + 0.5 + outwards * (1.0 + 0.9 * blur);
            ends[side].rows.push_back({y, edge[side], width, outwards * (end - edge[side])});
        }
    }
    for (RunEnds& side : ends) {
        side.step = step;
        side.spread = 0.75 + 0.5 * blur;
        side.near_by = near_by + widths / std::max(1.0, rows);
        side.tolerance = std::max(1.5 + 0.5 * blur, 0.03 * widths / std::max(1.0, rows));
    }
    return ends;
}

}  // namespace goalmouth
