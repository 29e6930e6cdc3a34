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

}  // namespace

template <class Part>
double RowGate::third_of(const EdgeRows& rows, Part part) {
    constexpr std::size_t room = EdgeRows::block;  // read by vectors
    chosen_.resize(rows.count + room);
    std::size_t count = 0;
    for (std::size_t i = 0; i < rows.count; ++i) {
        chosen_[count] = part(i);
        count += rows.told(i) ? 1 : 0;
    }
    return count > 0 ? static_cast<double>(nth_smallest(chosen_.data(), count, count / 3)) : 0.0;
}

template <class Part>
RowGate::Noise RowGate::noise_of(const Rows& rows, Part part) {
    // A third of the rows tells the noise: fewer than that are never clean.
    constexpr double cleanest = 0.3, third = -0.431;
    Noise noise = {1.0, 1.0};
    double least = most_noise;
    for (std::size_t side = 0; side < 2; ++side) {
        if (!(freedom_[side] > 0.0)) continue;
        const RowColumn<float>& column = part(rows[side]);
        noise[side] = std::max(cleanest, third_of(rows[side], [&](std::size_t i) { return column[i]; }) /
                                             mean_square(freedom_[side], third));
        least = std::min(least, noise[side]);
    }
    // Pixels worse than the colours' own noise by what both edges show are the camera's doing (compression,
    // sharpening); by more, the background's.
    for (double& n : noise) n = std::min({n, most_noise, worse * std::max(1.0, least)});
    return noise;
}

std::array<double, 2> RowGate::shading_of(const Rows& rows) {
    std::array<double, 2> shading{};
    for (std::size_t side = 0; side < 2; ++side)
        shading[side] = third_of(rows[side], [&](std::size_t i) { return rows[side].dark[i]; });
    // A post's shading is the same all along it, and loses no more than a few tenths of the last px's light.
    // Beyond that what both edges show is the camera's: a halo where it is alike, colour beside brightness
    // where it is opposite. What one of them alone does is a thing behind it.
    const double both = std::min(std::abs(shading[0]), std::abs(shading[1]));
    for (double& s : shading)
        s = std::clamp(s, std::min(brightest_edge, -both), std::max(darkest_edge, both));
    return shading;
}

std::array<double, 2> RowGate::scatter_of(const Rows& rows, const std::array<double, 2>& shading) {
    std::array<double, 2> scatter{};
    for (std::size_t side = 0; side < 2; ++side) {
        const auto usual = static_cast<float>(shading[side]);
        scatter[side] =
            third_of(rows[side], [&](std::size_t i) { return std::abs(local_[side].dark[i] - usual); }) /
            third_of_normal;
    }
    if (scatter[0] > 0.0 && scatter[1] > 0.0) {
        const double least = std::min(scatter[0], scatter[1]);
        for (double& s : scatter) s = std::min(s, worse * least);
    }
    return scatter;
}

void RowGate::weigh(Rows& rows, std::array<double, 2>& noise, const StepProfile& profile, bool gate) {
    constexpr std::size_t reach = 2;
    for (std::size_t side = 0; side < 2; ++side) {
        double freedom = 0.0, count = 0.0;
        for (std::size_t i = 0; i < rows[side].count; ++i) {
            if (!rows[side].told(i)) continue;
            freedom += static_cast<double>(rows[side].measured.freedom[i]);
            count += 1.0;
        }
        freedom_[side] = count > 0.0 ? std::max(1.0, freedom / count) : 0.0;
        if (!gate) continue;
        judge_rows(rows[side], profile, side == 0 ? -1.0F : 1.0F);
        LocalRows& local = local_[side];
        const auto spread = [&](const RowColumn<float>& part, RowColumn<float>& means) {
            means.assign(rows[side].count);
            local_means(rows[side], part, reach, means);
        };
        spread(rows[side].measured.misfit, local.misfit);
        spread(rows[side].stray, local.stray);
        spread(rows[side].dark, local.dark);
    }
    noise = noise_of(rows, [](const EdgeRows& r) -> const RowColumn<float>& { return r.measured.misfit; });
    Noise stray_noise = {1.0, 1.0};
    std::array<double, 2> shading{}, scatter{};
    if (gate) {
        stray_noise = noise_of(rows, [](const EdgeRows& r) -> const RowColumn<float>& { return r.stray; });
        shading = shading_of(rows);
        scatter = scatter_of(rows, shading);
    }

    chosen_.clear();
    for (const EdgeRows& side : rows)
        for (std::size_t i = 0; i < side.count; ++i)
            if (side.told(i) && side.outvoted[i] == 0.0F) {
                const double offset = static_cast<double>(side.measured.offset[i]);
                chosen_.push_back(static_cast<float>(offset * offset / side.variance(i)));
            }
    // A third here as well: of a scatter of two kinds it tells the narrower one.
    const std::size_t count = chosen_.size();
    chosen_.resize(count + EdgeRows::block);
    const double third =
        count > 0 ? std::sqrt(static_cast<double>(nth_smallest(chosen_.data(), count, count / 3))) : 0.0;
    const double spread = std::max(1.0, third / third_of_normal);
    for (std::size_t side = 0; side < 2; ++side) {
        if (!(freedom_[side] > 0.0)) freedom_[side] = 1.0;
        const double n = freedom_[side], of_local = 5.0 * n;
        const auto from_to = [](double usual, double most, double unit) {
            return Unusual{static_cast<float>(usual * unit), static_cast<float>(most * unit)};
        };
        constexpr double other = 0.2, quite_other = 0.45;  // px
        UsualRows usual;
        usual.gate = gate;
        usual.shading = static_cast<float>(shading[side]);
        usual.dark =
            from_to(std::max(other, 2.0 * scatter[side]), std::max(quite_other, 4.5 * scatter[side]), 1.0);
        usual.misfit = from_to(mean_square(n, 2.0), mean_square(n, 4.5), noise[side]);
        usual.stray = from_to(mean_square(n, 2.0), mean_square(n, 4.5), stray_noise[side]);
        usual.misfits = from_to(mean_square(of_local, 2.3), mean_square(of_local, 5.0), noise[side]);
        usual.strays = from_to(mean_square(of_local, 2.3), mean_square(of_local, 5.0), stray_noise[side]);
        usual.least_variance = static_cast<float>(edge_roughness * edge_roughness);
        usual.farthest = static_cast<float>(spread * tukey);
        weigh_rows(usual, local_[side], rows[side]);
    }
}

}  // namespace goalmouth
