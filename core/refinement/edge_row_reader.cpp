#include "core/refinement/edge_row_reader.h"

#include "core/refinement/row_purity.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <Eigen/LU>

namespace goalmouth {
namespace {

constexpr std::size_t neighbours = 4;  // rows on either side that help to tell a background's colour
constexpr int least_pairs = 3;

}  // namespace

void EdgeRowReader::place(const Intrinsics& camera, const Eigen::Vector3d& plane, const RowLayout& layout,
                          double x_near, EdgeRows& rows) {
    const double middle = 0.5 * (layout.bin - 1);
    curve_.follow(camera, plane, x_near, layout.top(0) + middle, layout.top(layout.count - 1) + middle);
    for (std::size_t i = 0; i < rows.count; ++i) {
        rows.row[i] = layout.top(static_cast<int>(i)) + middle;
        const RowRay ray = curve_.at(rows.row[i]);
        rows.column[i] = ray.x;
        rows.ray_x[i] = ray.ray.x(), rows.ray_y[i] = ray.ray.y();
        rows.slope_x[i] = ray.slope.x(), rows.slope_y[i] = ray.slope.y();
    }
}

void EdgeRowReader::copy(YuyvView image, const RowLayout& layout, std::size_t first_row,
                         const std::array<Window, EdgeRows::block>& windows) {
    const int pairs = image.width / 2;
    int most = 0;
    for (const Window& window : windows) most = std::max(most, window.pairs);
    if (most == 0) return;
    constexpr auto together = static_cast<int>(RawPairs::together);
    const int read = (most + 2 + together - 1) / together * together;
    std::array<int, EdgeRows::block> top{};
    for (std::size_t lane = 0; lane < EdgeRows::block; ++lane)
        if (windows[lane].pairs > 0) top[lane] = layout.top(static_cast<int>(first_row + lane));
    for (int k = 0; k < layout.bin; ++k) {
        std::array<const std::uint8_t*, EdgeRows::block> from;
        for (std::size_t lane = 0; lane < EdgeRows::block; ++lane) {
            const Window& window = windows[lane];
            from[lane] = apart_[lane].data();
            if (window.pairs == 0) continue;
            const int y = top[lane] + k;
            const std::uint8_t* const row = image.row(y);
            const int before = window.first - 1;
            const std::ptrdiff_t left =
                static_cast<std::ptrdiff_t>(image.height - 1 - y) * image.stride + 4 * pairs;
            if (before >= 0 && before + window.pairs + 2 <= pairs && 4 * (before + read) <= left) {
                from[lane] = row + 4 * before;
                continue;
            }
            for (int j = 0; j < window.pairs + 2; ++j)
                std::memcpy(apart_[lane].data() + 4 * j, row + 4 * std::clamp(before + j, 0, pairs - 1), 4);
        }
        lay_out(from, static_cast<std::size_t>(most) + 2, raw_.bins[static_cast<std::size_t>(k)]);
    }
}

void EdgeRowReader::read_side(YuyvView image, const PostColour& colour, const RowLayout& layout, double blur,
                              std::size_t side, std::array<EdgeRows, 2>& both) {
    EdgeRows& rows = both[side];
    const double outwards = side == 0 ? -1.0 : 1.0;
    const double clear = 2.2 * blur + 1.0;  // px
    const int pairs = image.width / 2;
    BackgroundSums& sums = sums_[side];
    for (RowColumn<float>& column : sums.colour) column.assign(rows.count);
    sums.pairs.assign(rows.count);
    outside_[side].assign(rows.count, {});
    start_.assign(rows.count);
    for (std::size_t block = 0; block < rows.blocks(); ++block) {
        const std::size_t from = block * EdgeRows::block;
        const std::size_t to = std::min(rows.count, from + EdgeRows::block);
        std::array<Window, EdgeRows::block> windows{};
        for (std::size_t i = from; i < to; ++i) {
            const double edge = rows.column[i], width = both[1].column[i] - both[0].column[i];
            if (!std::isfinite(edge) || !(width > 0.0)) continue;
            // An edge at the picture's border whose blur is cut off is no edge.
            const int least = PairRow::pair_at(edge + outwards * (2.0 * blur + 1.0));
            if (least < 0 || least >= pairs) continue;
            const double inner_end = edge - outwards * std::min(layout.inner, 0.5 * width);
            const double outer_end = edge + outwards * layout.outer;
            const int first = std::max(0, PairRow::pair_at(std::min(inner_end, outer_end)));
            const int last = std::min({PairRow::pair_at(std::max(inner_end, outer_end)), pairs - 1,
                                       first + static_cast<int>(EdgeRows::most_pairs) - 1});
            if (last - first + 1 < least_pairs) continue;
            rows.pairs[i] = static_cast<float>(last - first + 1);
            rows.first[i] = 2.0 * first + 0.5;
            rows.edge[i] = edge;
            start_[i] = static_cast<float>(outwards * (rows.first[i] - edge));
            const double away = 0.5 * (edge + outwards * clear - 0.5);
            outside_[side][i] = side == 0 ? Outside{first, first, std::min(last, whole_below(away))}
                                          : Outside{first, std::max(first, whole_above(away)), last};
            windows[i - from] = {first, last - first + 1};
        }
        copy(image, layout, from, windows);
        read_pairs(raw_, layout.bin, colour, block, static_cast<float>(outwards), static_cast<float>(clear),
                   start_, rows, sums);
    }
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < rows.count; ++i)
            rows.background[k][i] = sums.colour[k][i] / std::max(1.0F, sums.pairs[i]);
}

Eigen::Matrix3f EdgeRowReader::background_noise(std::size_t side, const EdgeRows& rows,
                                                const Eigen::Matrix3f& like) {
    // Between one row and the next. Where the background itself changes is no noise: what differs by much
    // more than usual is left out.
    constexpr std::size_t enough = 200;  // differences: the noise to a few per cent
    const Eigen::Matrix3f measure = like.inverse();
    differences_.clear();
    const std::vector<Outside>& outside = outside_[side];
    const auto shared = [&](std::size_t i) {
        const int first = std::max(outside[i].first, outside[i + 1].first);
        const int last = std::min(outside[i].last, outside[i + 1].last);
        return std::pair{first, rows.seen(i) && rows.seen(i + 1) ? last : first - 1};
    };
    std::size_t all = 0;
    for (std::size_t i = 0; i + 1 < rows.count; ++i) {
        const auto [first, last] = shared(i);
        all += static_cast<std::size_t>(std::max(0, last - first + 1));
    }
    const std::size_t step = std::max<std::size_t>(1, all / enough);
    const auto colour_at = [&](std::size_t i, int pair) {
        const EdgeRows::Pixels& pixels = rows.pixels[i / EdgeRows::block];
        const auto k = static_cast<std::size_t>(pair - outside[i].window_first);
        const std::size_t lane = i % EdgeRows::block;
        return Eigen::Vector3f(pixels.value[k][lane], pixels.stray[k][lane], pixels.luma[k][lane]);
    };
    for (std::size_t i = 0; i + 1 < rows.count; i += step) {
        const auto [first, last] = shared(i);
        for (int pair = first; pair <= last; ++pair) {
            const Eigen::Vector3f d = colour_at(i, pair) - colour_at(i + 1, pair);
            differences_.push_back({d, d.dot(measure * d)});
        }
    }
    if (differences_.empty()) return like;
    const std::size_t count_all = differences_.size();
    sizes_.resize(count_all + EdgeRows::block);
    for (std::size_t i = 0; i < count_all; ++i) sizes_[i] = differences_[i].size;
    // χ² with three degrees of freedom: 0.3 % are beyond.
    const float most = 6.0F * nth_smallest(sizes_.data(), count_all, count_all / 2);
    Eigen::Matrix3f sum = Eigen::Matrix3f::Zero();
    float count = 0.0F;
    for (const Difference& d : differences_) {
        if (d.size > most) continue;
        sum += d.colour * d.colour.transpose();
        count += 2.0F;
    }
    return sum / count;
}

void EdgeRowReader::read(YuyvView image, const Intrinsics& camera, const PostSilhouette& post,
                         const PostColour& colour, const RowLayout& layout, double blur,
                         double least_contrast, std::array<EdgeRows, 2>& rows) {
    const auto count = static_cast<std::size_t>(layout.count);
    const auto middle = project(camera, post.ahead);
    for (std::size_t side = 0; side < 2; ++side) {
        rows[side].assign(count);
        const double x_near = middle ? middle->x() : side == 0 ? 0.0 : camera.width - 1.0;
        place(camera, post.plane(side == 0 ? OutlineSide::left : OutlineSide::right), layout, x_near,
              rows[side]);
    }
    for (std::size_t side = 0; side < 2; ++side) {
        read_side(image, colour, layout, blur, side, rows);
        for (RowColumn<float>& column : backgrounds_[side]) column.assign(count);
        spread_background(sums_[side], count, neighbours, backgrounds_[side]);
    }
    const float gain = std::sqrt(static_cast<float>(layout.bin));
    const auto least = static_cast<float>(least_contrast * least_contrast);
    for (std::size_t side = 0; side < 2; ++side) {
        const Eigen::Matrix3f noise =
            0.5F * (colour.noise +
                    static_cast<float>(layout.bin) * background_noise(side, rows[side], colour.noise) +
                    Eigen::Matrix3f::Identity() * 0.1F);
        RowWeights& weights = weights_[side];
        for (auto* columns : {&weights.along, &weights.square})
            for (RowColumn<float>& column : *columns) column.assign(count);
        weigh_colours(contrast_matrix(noise, colour.shade), colour.shade, gain, least, backgrounds_[side],
                      backgrounds_[1 - side], rows[side], weights);
        project_pairs(weights, colour.mean[0], rows[side]);
    }
}

void EdgeRowReader::read_far(YuyvView image, const PostColour& colour, const RowLayout& layout,
                             std::array<EdgeRows, 2>& both) const {
    const int pairs = image.width / 2;
    for (std::size_t side = 0; side < 2; ++side) {
        EdgeRows& rows = both[side];
        const double outwards = side == 0 ? -1.0 : 1.0;
        for (std::size_t i = 0; i < rows.count; ++i) {
            if (!(rows.weight[i] > 0.0F)) continue;
            const int first = PairRow::pair_at(rows.first[i]);
            const int last = first + static_cast<int>(rows.pairs[i]) - 1;
            const int top = layout.top(static_cast<int>(i));
            const double width = both[1].column[i] - both[0].column[i];
            const int inner_end =
                PairRow::pair_at(rows.column[i] - outwards * std::min(layout.far_inner, 0.5 * width));
            const int outer_end = PairRow::pair_at(rows.column[i] + outwards * layout.far_outer);
            const auto level = [&](int from, int to, RowColumn<float>& mean, RowColumn<float>& number) {
                from = std::max(from, 0);
                to = std::min(to, pairs - 1);
                if (from > to) return;
                Eigen::Vector3f sum = Eigen::Vector3f::Zero();
                for (int k = 0; k < layout.bin; ++k)
                    PairRow(image.row(top + k), pairs, colour.response).add(from, to, sum);
                number[i] = static_cast<float>(to - from + 1);
                const Eigen::Vector3f e = sum / (number[i] * static_cast<float>(layout.bin)) - colour.mean;
                const auto& along = weights_[side].along;
                mean[i] = along[0][i] * e[0] + along[1][i] * e[1] + along[2][i] * e[2];
            };
            if (side == 0) {
                level(last + 1, inner_end, rows.far_inner, rows.far_inner_pairs);
                level(outer_end, first - 1, rows.far_outer, rows.far_outer_pairs);
            } else {
                level(inner_end, first - 1, rows.far_inner, rows.far_inner_pairs);
                level(last + 1, outer_end, rows.far_outer, rows.far_outer_pairs);
            }
        }
    }
}

}  // namespace goalmouth
