#include "core/refinement/row_gate.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

constexpr double most_noise = 25.0;  // times the colours' own variance: blocks of a compressed picture
constexpr double brightest_edge = -0.05,
                 darkest_edge = 0.25;       // px of black, as light from anywhere shades a cylinder
constexpr double third_of_normal = 0.4307;  // a third of all deviates are smaller
constexpr double worse = 2.5;               // than the better edge: no camera's doing
constexpr double tukey = 6.0;               // sigmas; 98 % efficient where nothing is wrong

/// χ²/n of n degrees of freedom that a normal deviate of `sigmas` stands for (Wilson and Hilferty, 1931).
double mean_square(double n, double sigmas) {
    const double t = 2.0 / (9.0 * n);
    const double root = std::max(0.05, 1.0 - t + sigmas * std::sqrt(t));
    return root * root * root;
}

double sigma_of(const EdgeRow& row) {
    return std::sqrt(1.0 / static_cast<double>(row.information) + edge_roughness * edge_roughness);
}

float third_of(std::vector<float>& values) {
    if (values.empty()) return 0.0F;
    const auto third = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 3);
    std::nth_element(values.begin(), third, values.end());
    return *third;
}

/// Mean square of a row's strays for each degree of freedom, a level on either side left out.
float stray_of(const EdgeRow& row, const StepProfile& profile, float outwards) {
    float aa = 0.0F, ab = 0.0F, bb = 0.0F, ra = 0.0F, rb = 0.0F, rr = 0.0F;
    const float start = outwards * (row.first - row.edge) - std::clamp(row.offset, -2.0F, 2.0F);
    for (int i = 0; i < row.pairs; ++i) {
        const float out = profile.at(start + 2.0F * outwards * static_cast<float>(i)).step;
        const float in = 1.0F - out;
        const float r = row.strays[static_cast<std::size_t>(i)];
        aa += in * in, ab += in * out, bb += out * out, ra += r * in, rb += r * out, rr += r * r;
    }
    aa += 1e-3F, bb += 1e-3F;
    const float det = aa * bb - ab * ab;
    const float explained = (bb * ra * ra - 2.0F * ab * ra * rb + aa * rb * rb) / det;
    return std::max(0.0F, rr - explained) / std::max(1.0F, static_cast<float>(row.pairs - 2));
}

/// How much light is missing just inside a row's edge of what its pixels farther in and outside let expect
/// [px of black].
float darkness_of(const EdgeRow& row, const StepProfile& profile, float outwards) {
    constexpr float well_inside = 0.03F, well_outside = 0.97F;
    float inner = 0.0F, inner_weight = 0.0F, outer = 0.0F, outer_weight = 0.0F;
    const float start = outwards * (row.first - row.edge) - std::clamp(row.offset, -3.0F, 3.0F);
    std::array<float, EdgeRow::most_pairs> share{};
    float nearest = -100.0F;  // well inside
    for (int i = 0; i < row.pairs; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const float x = start + 2.0F * outwards * static_cast<float>(i);
        share[k] = profile.at(x).step;
        if (share[k] < well_inside) {
            inner += row.lumas[k], inner_weight += 1.0F;
            nearest = std::max(nearest, x);
        }
        // The nearest of the background: farther out something else may lie.
        if (share[k] > well_outside && x < 6.0F) outer += row.lumas[k], outer_weight += 1.0F;
    }
    if (!(inner_weight > 0.0F) || !(outer_weight > 0.0F)) return 0.0F;
    inner /= inner_weight, outer /= outer_weight;
    float missing = 0.0F;
    for (int i = 0; i < row.pairs; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (share[k] < well_inside || share[k] > well_outside) continue;
        missing += inner + share[k] * (outer - inner) - row.lumas[k];
    }
    constexpr float least_luma = 16.0F;
    return 2.0F * missing / std::max(inner, least_luma);
}

/// Rows that can be judged.
bool told(const EdgeRow& row) {
    return row.seen && row.information > 0.0F;
}

double local_mean(const std::vector<EdgeRow>& rows, std::size_t i, float EdgeRow::*part) {
    constexpr std::size_t reach = 2;
    double sum = 0.0, count = 0.0;
    for (std::size_t k = i - std::min(i, reach); k < std::min(rows.size(), i + reach + 1); ++k) {
        if (!told(rows[k])) continue;
        sum += static_cast<double>(rows[k].*part);
        count += 1.0;
    }
    return sum / count;
}

}  // namespace

RowGate::Noise RowGate::noise_of(const std::array<std::vector<EdgeRow>, 2>& rows, float EdgeRow::*part) {
    // A third of the rows tells the noise: fewer than that are never clean.
    constexpr double cleanest = 0.3, third = -0.431;
    Noise noise = {1.0, 1.0};
    double least = most_noise;
    for (std::size_t side = 0; side < 2; ++side) {
        sorted_.clear();
        for (const EdgeRow& row : rows[side])
            if (told(row)) sorted_.push_back(row.*part);
        if (sorted_.empty()) continue;
        noise[side] =
            std::max(cleanest, static_cast<double>(third_of(sorted_)) / mean_square(freedom_[side], third));
        least = std::min(least, noise[side]);
    }
    // Pixels worse than the colours' own noise by what both edges show are the camera's doing (compression,
    // sharpening); by more, the background's.
    for (double& n : noise) n = std::min({n, most_noise, worse * std::max(1.0, least)});
    return noise;
}

std::array<double, 2> RowGate::shading_of(const std::array<std::vector<EdgeRow>, 2>& rows) {
    std::array<double, 2> shading{};
    for (std::size_t side = 0; side < 2; ++side) {
        sorted_.clear();
        for (const EdgeRow& row : rows[side])
            if (told(row)) sorted_.push_back(row.dark);
        shading[side] = static_cast<double>(third_of(sorted_));
    }
    // A post's shading is the same all along it, and loses no more than a few tenths of the last px's light.
    // Beyond that what both edges show is the camera's: a halo where it is alike, colour beside brightness
    // where it is opposite. What one of them alone does is a thing behind it.
    const double both = std::min(std::abs(shading[0]), std::abs(shading[1]));
    for (double& s : shading)
        s = std::clamp(s, std::min(brightest_edge, -both), std::max(darkest_edge, both));
    return shading;
}

std::array<double, 2> RowGate::scatter_of(const std::array<std::vector<EdgeRow>, 2>& rows,
                                          const std::array<double, 2>& shading) {
    std::array<double, 2> scatter{};
    for (std::size_t side = 0; side < 2; ++side) {
        sorted_.clear();
        for (std::size_t i = 0; i < rows[side].size(); ++i)
            if (told(rows[side][i]))
                sorted_.push_back(
                    static_cast<float>(std::abs(local_mean(rows[side], i, &EdgeRow::dark) - shading[side])));
        scatter[side] = static_cast<double>(third_of(sorted_)) / third_of_normal;
    }
    if (scatter[0] > 0.0 && scatter[1] > 0.0) {
        const double least = std::min(scatter[0], scatter[1]);
        for (double& s : scatter) s = std::min(s, worse * least);
    }
    return scatter;
}

void RowGate::weigh(std::array<std::vector<EdgeRow>, 2>& rows, std::array<double, 2>& noise,
                    const StepProfile& profile, bool gate) {
    for (std::size_t side = 0; side < 2; ++side) {
        double freedom = 0.0, count = 0.0;
        for (EdgeRow& row : rows[side]) {
            if (!told(row)) continue;
            freedom += static_cast<double>(row.freedom);
            count += 1.0;
            if (gate) row.dark = darkness_of(row, profile, side == 0 ? -1.0F : 1.0F);
            if (gate) row.stray = stray_of(row, profile, side == 0 ? -1.0F : 1.0F);
        }
        if (count > 0.0) freedom_[side] = std::max(1.0, freedom / count);
    }
    noise = noise_of(rows, &EdgeRow::misfit);
    Noise stray_noise = {1.0, 1.0};
    if (gate) stray_noise = noise_of(rows, &EdgeRow::stray);

    std::array<double, 2> shading{}, scatter{};
    if (gate) {
        shading = shading_of(rows);
        scatter = scatter_of(rows, shading);
    }

    sorted_.clear();
    for (const auto& side_rows : rows)
        for (const EdgeRow& row : side_rows)
            if (told(row) && !row.outvoted)
                sorted_.push_back(
                    static_cast<float>(std::abs(static_cast<double>(row.offset)) / sigma_of(row)));
    // A third here as well: of a scatter of two kinds it tells the narrower one.
    const double spread = std::max(1.0, static_cast<double>(third_of(sorted_)) / third_of_normal);
    for (std::size_t side = 0; side < 2; ++side) {
        std::vector<EdgeRow>& all = rows[side];
        const double own_usual = mean_square(freedom_[side], 2.0),
                     own_most = mean_square(freedom_[side], 4.5);
        const double local_usual = mean_square(5.0 * freedom_[side], 2.3),
                     local_most = mean_square(5.0 * freedom_[side], 5.0);
        const auto unlike = [&](std::size_t i, float EdgeRow::*part, double usual) {
            // What lies behind a post or before it does so in several rows, and where it begins and ends it
            // disturbs less than can be seen in one row.
            const double own = static_cast<double>(all[i].*part) / usual;
            const double local = local_mean(all, i, part) / usual;
            return std::max((local - local_usual) / (local_most - local_usual),
                            (own - own_usual) / (own_most - own_usual));
        };
        for (std::size_t i = 0; i < all.size(); ++i) {
            EdgeRow& row = all[i];
            row.weight = 0.0F;
            row.clean = 0.0F;
            if (!told(row)) continue;
            double clean = 1.0;
            if (gate) {
                constexpr double other = 0.2, quite_other = 0.45;  // px
                const double apart = std::abs(local_mean(all, i, &EdgeRow::dark) - shading[side]);
                const double usual = std::max(other, 2.0 * scatter[side]);
                const double most = std::max(quite_other, 4.5 * scatter[side]);
                const double dark = (apart - usual) / (most - usual);
                const double worst = std::max({0.0, dark, unlike(i, &EdgeRow::misfit, noise[side]),
                                               unlike(i, &EdgeRow::stray, stray_noise[side])});
                clean = std::max(0.0, 1.0 - worst * worst);
            }
            row.clean = static_cast<float>(clean * clean);
            if (row.outvoted) continue;
            const double miss = static_cast<double>(row.offset) / (sigma_of(row) * spread * tukey);
            const double near = std::max(0.0, 1.0 - miss * miss);
            row.weight = static_cast<float>(near * near * clean * clean);
        }
    }
}

}  // namespace goalmouth
