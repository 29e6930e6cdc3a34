#include "core/refinement/edge_rows.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace goalmouth {
namespace {

constexpr int neighbours = 4;  // rows on either side that help to tell a background's colour

int pair_at(double x) {
    constexpr double far = 1e6;  // px, beyond every picture
    return static_cast<int>(std::lround(0.5 * (std::clamp(x, -far, far) - 0.5)));
}

}  // namespace

RowLayout layout_rows(int first_row, int last_row, int most_rows) {
    constexpr int most_averaged = 2;
    RowLayout layout;
    layout.first_row = first_row;
    layout.last_row = last_row;
    const int rows = std::max(0, last_row - first_row + 1);
    layout.bin = std::clamp((rows + most_rows - 1) / most_rows, 1, most_averaged);
    layout.count = std::min(rows / layout.bin, most_rows);
    const int span = rows - layout.bin;
    layout.pitch =
        layout.count > 1 ? std::max<double>(layout.bin, static_cast<double>(span) / (layout.count - 1)) : 1.0;
    return layout;
}

void EdgeRowReader::read_window(YuyvView image, const RowLayout& layout, int top, double edge,
                                double outwards, double inner, double blur, const PostColour& colour,
                                Window& window) const {
    const double inner_end = edge - outwards * inner;
    const double outer_end = edge + outwards * layout.outer;
    int first = pair_at(std::min(inner_end, outer_end));
    int last = pair_at(std::max(inner_end, outer_end));
    window.pairs = 0;
    window.background.setZero();
    window.background_pairs = 0.0F;
    window.outside_first = 0;
    window.outside_last = -1;
    const int pairs = image.width / 2;
    // An edge at the picture's border whose blur is cut off is no edge.
    const int least = pair_at(edge + outwards * (2.0 * blur + 1.0));
    if (least < 0 || least >= pairs) return;
    first = std::max(first, 0);
    last = std::min({last, pairs - 1, first + EdgeRow::most_pairs - 1});
    if (last < first) return;
    window.first = first;
    window.pairs = last - first + 1;
    const float per_row = 1.0F / static_cast<float>(layout.bin);
    const double clear = edge + outwards * (2.2 * blur + 1.0);
    for (int i = 0; i < window.pairs; ++i) {
        PairColour z = PairColour::Zero();
        for (int k = 0; k < layout.bin; ++k)
            z += per_row * PairRow(image.row(top + k), pairs, colour.response)[first + i];
        const Eigen::Vector3f e = z - colour.mean;
        window.colours[static_cast<std::size_t>(i)] = e;
        if (outwards * (2.0 * (first + i) + 0.5 - clear) >= 0.0) {
            window.background += e;
            if (window.background_pairs == 0.0F) window.outside_first = i;
            window.outside_last = i;
            window.background_pairs += 1.0F;
        }
    }
}

Eigen::Matrix3f EdgeRowReader::background_noise(std::size_t side, const Eigen::Matrix3f& like) {
    // Between one row and the next. Where the background itself changes is no noise: what differs by much
    // more than usual is left out.
    const Eigen::Matrix3f measure = like.inverse();
    differences_.clear();
    for (std::size_t i = 0; i + 1 < windows_[side].size(); ++i) {
        const Window& a = windows_[side][i];
        const Window& b = windows_[side][i + 1];
        if (a.pairs == 0 || b.pairs == 0) continue;
        const int first = std::max(a.first + a.outside_first, b.first + b.outside_first);
        const int last = std::min(a.first + a.outside_last, b.first + b.outside_last);
        for (int pair = first; pair <= last; ++pair) {
            const Eigen::Vector3f d = a.colours[static_cast<std::size_t>(pair - a.first)] -
                                      b.colours[static_cast<std::size_t>(pair - b.first)];
            differences_.push_back({d, d.dot(measure * d)});
        }
    }
    if (differences_.empty()) return like;
    const auto middle = differences_.begin() + static_cast<std::ptrdiff_t>(differences_.size() / 2);
    std::nth_element(differences_.begin(), middle, differences_.end(),
                     [](const Difference& a, const Difference& b) { return a.size < b.size; });
    const float most = 6.0F * middle->size;  // χ² with three degrees of freedom: 0.3 % are beyond
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
                         double least_contrast, std::array<std::vector<EdgeRow>, 2>& rows) {
    const auto count = static_cast<std::size_t>(layout.count);
    std::array<Eigen::Vector3d, 2> planes = {post.plane(OutlineSide::left), post.plane(OutlineSide::right)};
    for (std::size_t side = 0; side < 2; ++side) {
        rows[side].resize(count);
        windows_[side].resize(count);
        backgrounds_[side].resize(count);
        PixelRays rays(camera);
        double x = side == 0 ? 0.0 : camera.width - 1.0;
        if (const auto middle = project(camera, post.ahead)) x = middle->x();
        for (std::size_t i = 0; i < count; ++i) {
            EdgeRow& row = rows[side][i];
            row = {};  // what another post or frame left there says nothing
            const int top =
                static_cast<int>(std::lround(layout.first_row + static_cast<double>(i) * layout.pitch));
            row.row = static_cast<float>(top + 0.5 * (layout.bin - 1));
            row.ray = rays.crossing(planes[side], x, row.row);
            row.seen = false;
            if (std::isfinite(row.ray.x) && std::abs(row.ray.x) < 2.0 * camera.width) x = row.ray.x;
        }
    }
    for (std::size_t side = 0; side < 2; ++side) {
        const double outwards = side == 0 ? -1.0 : 1.0;
        for (std::size_t i = 0; i < count; ++i) {
            const EdgeRow& row = rows[side][i];
            const double width = rows[1][i].ray.x - rows[0][i].ray.x;
            windows_[side][i].pairs = 0;
            windows_[side][i].background_pairs = 0.0F;
            windows_[side][i].background.setZero();
            if (!std::isfinite(row.ray.x) || !(width > 0.0)) continue;
            const int top = static_cast<int>(std::lround(row.row - 0.5 * (layout.bin - 1)));
            read_window(image, layout, top, row.ray.x, outwards, std::min(layout.inner, 0.5 * width), blur,
                        colour, windows_[side][i]);
        }
        for (std::size_t i = 0; i < count; ++i) {
            Eigen::Vector3f sum = Eigen::Vector3f::Zero();
            float pairs = 0.0F;
            const std::size_t from = i < neighbours ? 0 : i - neighbours;
            const std::size_t to = std::min(count, i + neighbours + 1);
            for (std::size_t k = from; k < to; ++k) {
                sum += windows_[side][k].background;
                pairs += windows_[side][k].background_pairs;
            }
            backgrounds_[side][i] = pairs > 0.0F ? Eigen::Vector3f(sum / pairs) : Eigen::Vector3f::Zero();
        }
    }
    const float gain = std::sqrt(static_cast<float>(layout.bin));
    const auto least = static_cast<float>(least_contrast * least_contrast);
    for (std::size_t side = 0; side < 2; ++side) {
        const Eigen::Matrix3f noise =
            0.5F * (colour.noise + static_cast<float>(layout.bin) * background_noise(side, colour.noise) +
                    Eigen::Matrix3f::Identity() * 0.1F);
        const Eigen::Matrix3f contrast = contrast_matrix(noise, colour.shade);
        for (std::size_t i = 0; i < count; ++i) {
            EdgeRow& row = rows[side][i];
            const Window& window = windows_[side][i];
            const Eigen::Vector3f weights = contrast * backgrounds_[side][i];
            const float strength = backgrounds_[side][i].dot(weights);
            constexpr int least_pairs = 3;
            if (window.pairs < least_pairs || !(strength >= least)) continue;
            const Eigen::Vector3f w = weights * (gain / std::sqrt(strength));
            const Eigen::Vector3f third = colour.shade.cross(backgrounds_[side][i]);
            const Eigen::Vector3f square =
                contrast * (third - third.dot(weights) / strength * backgrounds_[side][i]);
            const Eigen::Vector3f stray = square * (gain / std::sqrt(std::max(third.dot(square), 1e-12F)));
            row.seen = true;
            row.pairs = window.pairs;
            if (window.background_pairs > 0.0F)
                for (int k = 0; k < 3; ++k)
                    row.background[static_cast<std::size_t>(k)] =
                        window.background[k] / window.background_pairs;
            row.first = 2.0F * static_cast<float>(window.first) + 0.5F;
            for (int k = 0; k < window.pairs; ++k) {
                const Eigen::Vector3f& e = window.colours[static_cast<std::size_t>(k)];
                row.values[static_cast<std::size_t>(k)] = w.dot(e);
                row.strays[static_cast<std::size_t>(k)] = stray.dot(e);
                row.lumas[static_cast<std::size_t>(k)] = colour.mean[0] + e[0];
            }
            row.other_edge = w.dot(backgrounds_[1 - side][i]);
            const float outer = gain * std::sqrt(strength);
            row.inner = {0.0F, 1.0F};
            row.outer = {outer, outer * outer};
        }
    }
}

}  // namespace goalmouth
