#include "core/refinement/row_measurement.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace goalmouth {

namespace {

template <bool with_blur>
void measure(EdgeRow& row, const StepProfile& profile, double edge, double outwards, double width,
             double noise, BlurEvidence* blur) {
    const float a = row.inner.value;
    const float b = row.outer.value;
    const float height = b - a;
    const auto out = static_cast<float>(outwards);
    const float start = out * (row.first - static_cast<float>(edge));
    const float step = 2.0F * out;
    float tt = 0.0F, ta = 0.0F, tb = 0.0F, aa = 0.0F, ab = 0.0F, bb = 0.0F;
    float rt = 0.0F, ra = 0.0F, rb = 0.0F, rr = 0.0F;
    float ss = 0.0F, sd = 0.0F, dd = 0.0F, rs = 0.0F, rd = 0.0F, ts = 0.0F, td = 0.0F;
    float sa = 0.0F, sb = 0.0F, da = 0.0F, db = 0.0F;
    float inner = 0.0F, inner_weight = 0.0F, outer = 0.0F, outer_weight = 0.0F;
    const auto across = static_cast<float>(width);
    for (int i = 0; i < row.pairs; ++i) {
        const float x = start + step * static_cast<float>(i);
        const StepProfile::Value e = profile.at(x);
        float value = row.values[static_cast<std::size_t>(i)];
        if (across > 0.0F) value -= (row.other_edge - a) * profile.at(-x - across).step;
        const float r = value - a - height * e.step;
        const float t = -height * e.slope;
        const float in = 1.0F - e.step;
        if (e.step > 0.9F) {
            outer += e.step * (value - in * a);
            outer_weight += e.step * e.step;
        } else if (in > 0.9F) {
            inner += in * (value - e.step * b);
            inner_weight += in * in;
        }
        tt += t * t, ta += t * in, tb += t * e.step;
        aa += in * in, ab += in * e.step, bb += e.step * e.step;
        rt += r * t, ra += r * in, rb += r * e.step, rr += r * r;
        if constexpr (with_blur) {
            const float s = height * e.blur;
            const float d = height * e.digital;
            ss += s * s, sd += s * d, dd += d * d, rs += r * s, rd += r * d, ts += t * s, td += t * d;
            sa += s * in, sb += s * e.step, da += d * in, db += d * e.step;
        }
    }
    row.own_inner = {inner_weight > 0.0F ? inner / inner_weight : a, inner_weight};
    row.own_outer = {outer_weight > 0.0F ? outer / outer_weight : b, outer_weight};
    const auto n = static_cast<float>(noise);
    // Levels eliminated; everything in units of the noise's variance.
    const float pa = n / std::max(row.inner.variance, 1e-6F);
    const float pb = n / std::max(row.outer.variance, 1e-6F);
    const float naa = aa + pa, nbb = bb + pb;
    const float det = naa * nbb - ab * ab;
    const float ia = nbb / det, iab = -ab / det, ib = naa / det;
    const float ca = ia * ta + iab * tb;  // (N_ll + P)⁻¹ N_lt
    const float cb = iab * ta + ib * tb;
    const float left = tt - ta * ca - tb * cb;
    if (!(left > 0.0F) || !std::isfinite(left)) {
        row.offset = 0.0F;
        row.information = 0.0F;
        row.misfit = 0.0F;
        return;
    }
    const float reduced = rt - ca * ra - cb * rb;
    row.offset = reduced / left;
    row.information = left / n;
    const float la = ia * ra + iab * rb, lb = iab * ra + ib * rb;
    const float used = 1.0F + (ia * aa + 2.0F * iab * ab + ib * bb);  // degrees of freedom, of the levels
    const float rest = rr - (ra * la + rb * lb) - reduced * row.offset;
    row.freedom = std::max(1.0F, static_cast<float>(row.pairs) - used);
    row.misfit = std::max(0.0F, rest) / row.freedom;
    if constexpr (with_blur) {
        // The same for what they say about the blur, levels and offset eliminated.
        const float s_a = ia * sa + iab * sb, s_b = iab * sa + ib * sb;
        const float d_a = ia * da + iab * db, d_b = iab * da + ib * db;
        const float st = ts - (sa * ca + sb * cb), dt = td - (da * ca + db * cb);
        const float w = row.weight / n, per = 1.0F / left;
        blur->information(0, 0) += static_cast<double>(w * (ss - sa * s_a - sb * s_b - st * st * per));
        blur->information(0, 1) += static_cast<double>(w * (sd - sa * d_a - sb * d_b - st * dt * per));
        blur->information(1, 1) += static_cast<double>(w * (dd - da * d_a - db * d_b - dt * dt * per));
        blur->pull[0] += static_cast<double>(w * (rs - ra * s_a - rb * s_b - st * row.offset));
        blur->pull[1] += static_cast<double>(w * (rd - ra * d_a - rb * d_b - dt * row.offset));
    }
}

}  // namespace

void measure_row(EdgeRow& row, const StepProfile& profile, double edge, double outwards, double width,
                 double noise, BlurEvidence* blur) {
    if (blur != nullptr)
        measure<true>(row, profile, edge, outwards, width, noise, blur);
    else
        measure<false>(row, profile, edge, outwards, width, noise, nullptr);
}

void LevelSmoother::add_up(const std::vector<EdgeRow>& rows, OwnLevel EdgeRow::*own) {
    sums_.resize(rows.size() + 1);
    sums_[0] = {};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        sums_[i + 1] = sums_[i];
        const OwnLevel& level = rows[i].*own;
        if (!rows[i].seen || !(level.weight > 0.0F)) continue;
        const auto w = static_cast<double>(level.weight);
        const auto v = static_cast<double>(level.value);
        sums_[i + 1].weight += w;
        sums_[i + 1].value += w * v;
        sums_[i + 1].square += w * v * v;
        sums_[i + 1].count += 1.0;
    }
}

EdgeLevel LevelSmoother::level(std::size_t row, std::size_t reach, const OwnLevel& own, double noise) const {
    constexpr double unknown = 1e4;
    const std::size_t rows = sums_.size() - 1;
    struct Found {
        double mean = 0.0, scatter = 0.0, weight = 0.0, count = 0.0;
    };
    // Rows from…to, the row itself left out.
    const auto between = [&](std::size_t from, std::size_t to) {
        Sums sum;
        const auto add = [&](std::size_t first, std::size_t last) {
            sum.weight += sums_[last].weight - sums_[first].weight;
            sum.value += sums_[last].value - sums_[first].value;
            sum.square += sums_[last].square - sums_[first].square;
            sum.count += sums_[last].count - sums_[first].count;
        };
        if (from < row) add(from, std::min(row, to));
        if (to > row + 1) add(std::max(row + 1, from), to);
        Found found;
        if (!(sum.weight > 0.5)) return found;
        found.mean = sum.value / sum.weight;
        found.scatter = std::max(0.0, sum.square / sum.weight - found.mean * found.mean);
        found.weight = sum.weight;
        found.count = sum.count;
        return found;
    };
    const auto real = [&](const Found& f) { return std::max(0.0, f.scatter - noise * f.count / f.weight); };
    const std::size_t before = row - std::min(row, reach), after = std::min(rows, row + 1 + reach);
    Found best = between(before, after);
    const double own_weight = std::max(0.25, static_cast<double>(own.weight));
    const auto unlike = [&](const Found& f) {
        const double d = f.mean - static_cast<double>(own.value);
        return d * d - noise / own_weight;
    };
    if (best.weight > 0.0 &&
        std::max(real(best), unlike(best)) > 10.0 * noise * (best.count / best.weight + 1.0 / own_weight)) {
        const Found above = between(row - std::min(row, 2 * reach), row);
        const Found below = between(row + 1, std::min(rows, row + 1 + 2 * reach));
        for (const Found& side : {above, below})
            if (side.weight > 0.0 && real(side) + unlike(side) < real(best) + unlike(best)) best = side;
    }
    if (!(best.weight > 0.0)) return {own.value, static_cast<float>(unknown)};
    const double variance =
        real(best) + std::max(0.0, unlike(best) - 6.0 * noise / own_weight) + noise / best.weight;
    return {static_cast<float>(best.mean), static_cast<float>(variance)};
}

void LevelSmoother::smooth(std::vector<EdgeRow>& rows, double noise) {
    constexpr std::size_t outer_reach = 6, inner_reach = 12;
    add_up(rows, &EdgeRow::own_inner);
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].seen) rows[i].inner = level(i, inner_reach, rows[i].own_inner, noise);
    add_up(rows, &EdgeRow::own_outer);
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].seen) rows[i].outer = level(i, outer_reach, rows[i].own_outer, noise);
}

}  // namespace goalmouth
