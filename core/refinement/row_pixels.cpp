#include "core/refinement/row_pixels.h"

#include <algorithm>
#include <cstring>

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/refinement/row_pixels.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>
//
#include "core/refinement/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::Rebind<std::uint32_t, Floats>;
using WordVector = hn::Vec<Words>;

struct Colour {
    FloatVector y, cb, cr;
};

HWY_INLINE FloatVector number(float x) {
    return hn::Set(Floats(), x);
}

template <int shift>
HWY_INLINE FloatVector byte_of(WordVector word) {
    const auto byte = hn::And(hn::ShiftRight<shift>(word), hn::Set(Words(), 255U));
    return hn::ConvertTo(Floats(), hn::BitCast(hn::RebindToSigned<Floats>(), byte));
}

HWY_INLINE FloatVector scaled(FloatVector a, float b) {
    return hn::Mul(a, number(b));
}

/// light_of_level() of levels 0…255.
HWY_INLINE FloatVector light(FloatVector level) {
    const auto v = hn::Min(hn::Max(scaled(level, 1.0F / 255.0F), number(0.0F)), number(1.0F));
    const auto inner = hn::Add(number(light_factors[1]), scaled(v, light_factors[2]));
    return scaled(hn::Mul(v, hn::Add(number(light_factors[0]), hn::Mul(v, inner))), 255.0F);
}

/// light_of_level() of a colour; BT.601, full range.
HWY_INLINE Colour light(const Colour& c) {
    const auto red = light(hn::Add(c.y, scaled(c.cr, 1.402F)));
    const auto green = light(hn::Sub(hn::Sub(c.y, scaled(c.cb, 0.344136F)), scaled(c.cr, 0.714136F)));
    const auto blue = light(hn::Add(c.y, scaled(c.cb, 1.772F)));
    const auto luma = hn::Add(hn::Add(scaled(red, 0.299F), scaled(green, 0.587F)), scaled(blue, 0.114F));
    return {luma, scaled(hn::Sub(blue, luma), 1.0F / 1.772F), scaled(hn::Sub(red, luma), 1.0F / 1.402F)};
}

/// As PairRow has it.
HWY_INLINE Colour pair_colour(const RawPairs::Rows& rows, std::size_t pair, std::size_t lane,
                              CameraResponse response) {
    const Words w;
    const auto here = hn::Load(w, rows[pair + 1].data() + lane);
    const auto y0 = byte_of<0>(here), y1 = byte_of<16>(here);
    const auto cb = hn::Sub(byte_of<8>(here), number(128.0F));
    const auto cr = hn::Sub(byte_of<24>(here), number(128.0F));
    if (response == CameraResponse::linear) return {scaled(hn::Add(y0, y1), 0.5F), cb, cr};
    const auto before = hn::Load(w, rows[pair].data() + lane),
               after = hn::Load(w, rows[pair + 2].data() + lane);
    const auto cb_step = scaled(hn::Sub(byte_of<8>(after), byte_of<8>(before)), 0.125F);
    const auto cr_step = scaled(hn::Sub(byte_of<24>(after), byte_of<24>(before)), 0.125F);
    const Colour first = light(Colour{y0, hn::Sub(cb, cb_step), hn::Sub(cr, cr_step)});
    const Colour second = light(Colour{y1, hn::Add(cb, cb_step), hn::Add(cr, cr_step)});
    return {scaled(hn::Add(first.y, second.y), 0.5F), scaled(hn::Add(first.cb, second.cb), 0.5F),
            scaled(hn::Add(first.cr, second.cr), 0.5F)};
}

void lay_out(const std::array<const std::uint8_t*, EdgeRows::block>& from, std::size_t pairs,
             RawPairs::Rows& raw) {
#if HWY_TARGET == HWY_SCALAR
    for (std::size_t k = 0; k < pairs; ++k)
        for (std::size_t lane = 0; lane < EdgeRows::block; ++lane)
            std::memcpy(&raw[k][lane], from[lane] + 4 * k, 4);
#else
    // Four pairs of four rows at a time, turned about.
    const hn::Full128<std::uint8_t> bytes;
    const hn::Full128<std::uint32_t> words;
    const hn::Full128<std::uint64_t> twos;
    for (std::size_t lane = 0; lane < EdgeRows::block; lane += 4) {
        for (std::size_t k = 0; k < pairs; k += RawPairs::together) {
            const auto row = [&](std::size_t i) HWY_ATTR {
                return hn::BitCast(words, hn::LoadU(bytes, from[lane + i] + 4 * k));
            };
            const auto a = row(0), b = row(1), c = row(2), d = row(3);
            const auto lower_ab = hn::BitCast(twos, hn::InterleaveLower(words, a, b));
            const auto upper_ab = hn::BitCast(twos, hn::InterleaveUpper(words, a, b));
            const auto lower_cd = hn::BitCast(twos, hn::InterleaveLower(words, c, d));
            const auto upper_cd = hn::BitCast(twos, hn::InterleaveUpper(words, c, d));
            const auto store = [&](hn::Vec<decltype(twos)> v, std::size_t i) HWY_ATTR {
                hn::Store(hn::BitCast(words, v), words, raw[k + i].data() + lane);
            };
            store(hn::InterleaveLower(twos, lower_ab, lower_cd), 0);
            store(hn::InterleaveUpper(twos, lower_ab, lower_cd), 1);
            store(hn::InterleaveLower(twos, upper_ab, upper_cd), 2);
            store(hn::InterleaveUpper(twos, upper_ab, upper_cd), 3);
        }
    }
#endif
}

/// The most pairs of any row in some lanes.
HWY_INLINE std::size_t most_pairs(FloatVector pairs) {
    return static_cast<std::size_t>(hn::GetLane(hn::MaxOfLanes(Floats(), pairs)));
}

void read_pairs(const RawPairs& raw, int bin, const PostColour& colour, std::size_t block, float outwards,
                float clear, const RowColumn<float>& start, EdgeRows& rows, BackgroundSums& background) {
    const Floats d;
    EdgeRows::Pixels& pixels = rows.pixels[block];
    const float share = 1.0F / static_cast<float>(bin);
    for (std::size_t lane = 0; lane < EdgeRows::block; lane += hn::Lanes(d)) {
        const std::size_t row = EdgeRows::block * block + lane;
        const auto pairs = hn::LoadU(d, rows.pairs.data() + row);
        const auto first = hn::LoadU(d, start.data() + row);
        auto y = hn::Zero(d), cb = hn::Zero(d), cr = hn::Zero(d), count = hn::Zero(d);
        for (std::size_t i = 0; i < most_pairs(pairs); ++i) {
            Colour c = pair_colour(raw.bins[0], i, lane, colour.response);
            for (std::size_t k = 1; k < static_cast<std::size_t>(bin); ++k) {
                const Colour below = pair_colour(raw.bins[k], i, lane, colour.response);
                c = {hn::Add(c.y, below.y), hn::Add(c.cb, below.cb), hn::Add(c.cr, below.cr)};
            }
            const auto inside = hn::Lt(number(static_cast<float>(i)), pairs);
            c = {hn::IfThenElseZero(inside, hn::Sub(scaled(c.y, share), number(colour.mean[0]))),
                 hn::IfThenElseZero(inside, hn::Sub(scaled(c.cb, share), number(colour.mean[1]))),
                 hn::IfThenElseZero(inside, hn::Sub(scaled(c.cr, share), number(colour.mean[2])))};
            hn::Store(c.y, d, pixels.value[i].data() + lane);
            hn::Store(c.cb, d, pixels.stray[i].data() + lane);
            hn::Store(c.cr, d, pixels.luma[i].data() + lane);
            const auto x = hn::Add(first, number(2.0F * outwards * static_cast<float>(i)));
            const auto outside = hn::And(inside, hn::Ge(x, number(clear)));
            y = hn::Add(y, hn::IfThenElseZero(outside, c.y));
            cb = hn::Add(cb, hn::IfThenElseZero(outside, c.cb));
            cr = hn::Add(cr, hn::IfThenElseZero(outside, c.cr));
            count = hn::Add(count, hn::IfThenElseZero(outside, number(1.0F)));
        }
        hn::StoreU(y, d, background.colour[0].data() + row);
        hn::StoreU(cb, d, background.colour[1].data() + row);
        hn::StoreU(cr, d, background.colour[2].data() + row);
        hn::StoreU(count, d, background.pairs.data() + row);
    }
}

HWY_INLINE FloatVector sum_about(const float* at, std::size_t reach) {
    const Floats d;
    auto sum = hn::Zero(d);
    for (const float* p = at - reach; p <= at + reach; ++p) sum = hn::Add(sum, hn::LoadU(d, p));
    return sum;
}

void spread_background(const BackgroundSums& sums, std::size_t rows, std::size_t reach,
                       std::array<RowColumn<float>, 3>& background) {
    const Floats d;
    for (std::size_t i = 0; i < rows; i += hn::Lanes(d)) {
        const auto pairs = hn::Max(sum_about(sums.pairs.data() + i, reach), number(1.0F));
        for (std::size_t k = 0; k < 3; ++k)
            hn::StoreU(hn::Div(sum_about(sums.colour[k].data() + i, reach), pairs), d,
                       background[k].data() + i);
    }
}

struct Vector3 {
    FloatVector x, y, z;
};

HWY_INLINE FloatVector dot(const Vector3& a, const Vector3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE FloatVector row_times(const Eigen::Matrix3f& m, int row, const Vector3& a) {
    return hn::Add(hn::Add(scaled(a.x, m(row, 0)), scaled(a.y, m(row, 1))), scaled(a.z, m(row, 2)));
}

HWY_INLINE Vector3 times(const Eigen::Matrix3f& m, const Vector3& a) {
    return {row_times(m, 0, a), row_times(m, 1, a), row_times(m, 2, a)};
}

HWY_INLINE Vector3 load(const std::array<RowColumn<float>, 3>& columns, std::size_t i) {
    const Floats d;
    return {hn::LoadU(d, columns[0].data() + i), hn::LoadU(d, columns[1].data() + i),
            hn::LoadU(d, columns[2].data() + i)};
}

HWY_INLINE void store(const Vector3& a, FloatVector factor, std::array<RowColumn<float>, 3>& columns,
                      std::size_t i) {
    const Floats d;
    hn::StoreU(hn::Mul(a.x, factor), d, columns[0].data() + i);
    hn::StoreU(hn::Mul(a.y, factor), d, columns[1].data() + i);
    hn::StoreU(hn::Mul(a.z, factor), d, columns[2].data() + i);
}

void weigh_colours(const Eigen::Matrix3f& contrast, const Eigen::Vector3f& shade, float gain, float least,
                   const std::array<RowColumn<float>, 3>& own, const std::array<RowColumn<float>, 3>& other,
                   EdgeRows& rows, RowWeights& weights) {
    const Floats d;
    for (std::size_t i = 0; i < rows.count; i += hn::Lanes(d)) {
        const Vector3 background = load(own, i);
        const Vector3 w = times(contrast, background);
        const auto strength = dot(background, w);
        const auto differs = hn::Ge(strength, number(least));
        const auto root = hn::Sqrt(hn::Max(strength, number(1e-12F)));
        const auto per_root = hn::Div(number(gain), root);
        // What is square to w in the noise's metric, shading left out: of shade × background.
        const Vector3 third = {hn::Sub(scaled(background.z, shade[1]), scaled(background.y, shade[2])),
                               hn::Sub(scaled(background.x, shade[2]), scaled(background.z, shade[0])),
                               hn::Sub(scaled(background.y, shade[0]), scaled(background.x, shade[1]))};
        const auto part = hn::Div(dot(third, w), hn::Max(strength, number(1e-12F)));
        const Vector3 square = times(contrast, Vector3{hn::Sub(third.x, hn::Mul(part, background.x)),
                                                       hn::Sub(third.y, hn::Mul(part, background.y)),
                                                       hn::Sub(third.z, hn::Mul(part, background.z))});
        const auto per_square = hn::Div(number(gain), hn::Sqrt(hn::Max(dot(third, square), number(1e-12F))));
        store(w, per_root, weights.along, i);
        store(square, per_square, weights.square, i);
        const auto pairs = hn::IfThenElseZero(differs, hn::LoadU(d, rows.pairs.data() + i));
        hn::StoreU(pairs, d, rows.pairs.data() + i);
        const auto outer = hn::IfThenElseZero(differs, hn::Mul(number(gain), root));
        hn::StoreU(outer, d, rows.outer.data() + i);
        hn::StoreU(hn::Mul(outer, outer), d, rows.outer_variance.data() + i);
        hn::StoreU(number(1.0F), d, rows.inner_variance.data() + i);
        hn::StoreU(hn::Mul(dot(w, load(other, i)), per_root), d, rows.other_edge.data() + i);
    }
}

void project_pairs(const RowWeights& weights, float luma, EdgeRows& rows) {
    const Floats d;
    for (std::size_t i = 0; i < rows.count; i += hn::Lanes(d)) {
        EdgeRows::Pixels& pixels = rows.pixels[i / EdgeRows::block];
        const std::size_t lane = i % EdgeRows::block;
        const Vector3 along = load(weights.along, i), square = load(weights.square, i);
        const std::size_t pairs = most_pairs(hn::LoadU(d, rows.pairs.data() + i));
        for (std::size_t k = 0; k < pairs; ++k) {
            float* const value = pixels.value[k].data() + lane;
            float* const stray = pixels.stray[k].data() + lane;
            float* const bright = pixels.luma[k].data() + lane;
            const Vector3 e = {hn::Load(d, value), hn::Load(d, stray), hn::Load(d, bright)};
            hn::Store(dot(along, e), d, value);
            hn::Store(dot(square, e), d, stray);
            hn::Store(hn::Add(e.x, number(luma)), d, bright);
        }
    }
}

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(lay_out);
HWY_EXPORT(read_pairs);
HWY_EXPORT(spread_background);
HWY_EXPORT(weigh_colours);
HWY_EXPORT(project_pairs);

void lay_out(const std::array<const std::uint8_t*, EdgeRows::block>& from, std::size_t pairs,
             RawPairs::Rows& raw) {
    HWY_DYNAMIC_DISPATCH(lay_out)(from, pairs, raw);
}

void read_pairs(const RawPairs& raw, int bin, const PostColour& colour, std::size_t block, float outwards,
                float clear, const RowColumn<float>& start, EdgeRows& rows, BackgroundSums& background) {
    HWY_DYNAMIC_DISPATCH(read_pairs)(raw, bin, colour, block, outwards, clear, start, rows, background);
}

void spread_background(const BackgroundSums& sums, std::size_t rows, std::size_t reach,
                       std::array<RowColumn<float>, 3>& background) {
    HWY_DYNAMIC_DISPATCH(spread_background)(sums, rows, reach, background);
}

void weigh_colours(const Eigen::Matrix3f& contrast, const Eigen::Vector3f& shade, float gain, float least,
                   const std::array<RowColumn<float>, 3>& own, const std::array<RowColumn<float>, 3>& other,
                   EdgeRows& rows, RowWeights& weights) {
    HWY_DYNAMIC_DISPATCH(weigh_colours)(contrast, shade, gain, least, own, other, rows, weights);
}

void project_pairs(const RowWeights& weights, float luma, EdgeRows& rows) {
    HWY_DYNAMIC_DISPATCH(project_pairs)(weights, luma, rows);
}

}  // namespace goalmouth
#endif
