#include "core/refinement/run_ends.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace goalmouth {
namespace {

constexpr float unlike = 20.0F;  // eᵀMe of a pair that is not of the post's colour

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

/// How many distances lie about one place, and the most about any place farther than `tolerance` from those.
RunEnds count(std::vector<double>& distances, double usual, double tolerance) {
    RunEnds ends;
    std::sort(distances.begin(), distances.end());
    for (const double d : distances) ends.here += std::abs(d - usual) <= tolerance ? 1 : 0;
    std::size_t first = 0;
    for (std::size_t last = 0; last < distances.size(); ++last) {
        while (distances[last] - distances[first] > 2.0 * tolerance) ++first;
        const double middle = 0.5 * (distances[first] + distances[last]);
        if (std::abs(middle - usual) > 2.0 * tolerance)
            ends.elsewhere = std::max(ends.elsewhere, static_cast<int>(last - first) + 1);
    }
    return ends;
}

}  // namespace

std::array<RunEnds, 2> run_ends(YuyvView image, const PostSilhouette& post, const PostColour& colour,
                                const Intrinsics& camera, const PostExtent& extent, double blur) {
    constexpr int most_rows = 100;
    constexpr double beyond = 6.0;  // px, and a width: how far outside an edge
    constexpr std::array<double, 3> middles = {0.5, 0.4, 0.6};
    const std::array<Eigen::Vector3d, 2> planes = {post.plane(OutlineSide::left),
                                                   post.plane(OutlineSide::right)};
    const int step = std::max(1, (extent.last_edge_row - extent.first_edge_row + 1) / most_rows);
    const auto centre = project(camera, post.ahead);
    PixelRays rays(camera);
    std::array<double, 2> edge{};
    edge.fill(centre ? centre->x() : camera.cx);
    std::array<std::vector<double>, 2> distances;
    double widths = 0.0, rows = 0.0;
    for (int y = extent.first_edge_row; y <= extent.last_edge_row; y += step) {
        for (std::size_t side = 0; side < 2; ++side)
            edge[side] = rays.crossing(planes[side], edge[side], y).x;
        const double width = edge[1] - edge[0];
        constexpr double far = 1e5;  // px
        if (!(width > 1.0 && std::abs(edge[0]) < far && std::abs(edge[1]) < far)) return {};
        widths += width;
        rows += 1.0;
        const ColourRow row(image, y, colour);
        const auto middle = std::find_if(middles.begin(), middles.end(), [&](double share) {
            return row.shows(PairRow::pair_at(edge[0] + share * width));
        });
        if (middle == middles.end()) continue;
        for (std::size_t side = 0; side < 2; ++side) {
            const int outwards = side == 0 ? -1 : 1;
            const int last = PairRow::pair_at(edge[side] + outwards * (width + beyond));
            // In strides as long as the post's colour goes on, then pair by pair. What is narrower than a
            // stride, a twelfth of the post, does not end it.
            int pair = PairRow::pair_at(edge[0] + *middle * width);
            for (int stride = std::max(1, static_cast<int>(width / 24.0)); stride > 0; stride /= 2)
                while (outwards * (last - pair) >= stride && row.shows(pair + outwards * stride))
                    pair += outwards * stride;
            // Between the last pair and the next.
            if (pair != last && row.holds(pair + outwards))
                distances[side].push_back(outwards * (2.0 * pair + 0.5 + outwards - edge[side]));
        }
    }
    if (!(rows > 0.0)) return {};
    // The colour is left before half of it is another's.
    const double usual = -0.9 * blur;
    const double tolerance = std::max(1.5 + 0.5 * blur, 0.08 * widths / rows);
    return {count(distances[0], usual, tolerance), count(distances[1], usual, tolerance)};
}

}  // namespace goalmouth
