#include "core/simulation/sensor.h"

#include "core/simulation/vectorised.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

namespace goalmouth {
namespace {

// ITU-R BT.601, full range.
constexpr float y_r = 0.299F, y_g = 0.587F, y_b = 0.114F;
constexpr float cb_r = -0.168736F, cb_g = -0.331264F, cb_b = 0.5F;
constexpr float cr_r = 0.5F, cr_g = -0.418688F, cr_b = -0.081312F;

constexpr std::size_t noise_count = 1U << 16U;
constexpr int most_fixed_reach = 6;  // beyond it, blurs so wide that nobody waits for them

/// out[i] = Σ kernel[k] · in[k][i]. The kernel is symmetric. A reach known in advance keeps the sum of a
/// pixel in a register.
template <int reach>
[[gnu::always_inline]] inline void blur_fixed(const float* const* in, const float* kernel,
                                              float* __restrict out, std::size_t count) {
    float weight[reach + 1];
    const float* one[reach + 1];
    const float* other[reach + 1];
    for (int k = 0; k <= reach; ++k) {
        weight[k] = kernel[k];
        one[k] = in[k];
        other[k] = in[2 * reach - k];
    }
    for (std::size_t i = 0; i < count; ++i) {
        float sum = weight[reach] * one[reach][i];
        for (int k = 0; k < reach; ++k) sum += weight[k] * (one[k][i] + other[k][i]);
        out[i] = sum;
    }
}

[[gnu::always_inline]] inline void blur_any(const float* const* in, const float* kernel, int reach,
                                            float* __restrict out, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) out[i] = kernel[reach] * in[reach][i];
    for (int k = 0; k < reach; ++k) {
        const float weight = kernel[k];
        const float* one = in[k];
        const float* other = in[2 * reach - k];
        for (std::size_t i = 0; i < count; ++i) out[i] += weight * (one[i] + other[i]);
    }
}

GOALMOUTH_VECTORISED void blur(const float* const* in, const float* kernel, int reach, float* out,
                               std::size_t count) {
    switch (reach) {
        case 1:
            return blur_fixed<1>(in, kernel, out, count);
        case 2:
            return blur_fixed<2>(in, kernel, out, count);
        case 3:
            return blur_fixed<3>(in, kernel, out, count);
        case 4:
            return blur_fixed<4>(in, kernel, out, count);
        case 5:
            return blur_fixed<5>(in, kernel, out, count);
        case most_fixed_reach:
            return blur_fixed<most_fixed_reach>(in, kernel, out, count);
        default:
            return blur_any(in, kernel, reach, out, count);
    }
}

GOALMOUTH_VECTORISED void scale(float* __restrict levels, const float* factors, std::size_t count,
                                float gain) {
    for (std::size_t i = 0; i < count; ++i) levels[i] *= gain * factors[i];
}

/// Adds noise of variance read + photon · level.
GOALMOUTH_VECTORISED void add_noise(float* __restrict levels, const float* normal, std::size_t count,
                                    float read, float photon) {
    for (std::size_t i = 0; i < count; ++i) {
        const float light = levels[i] > 0.0F ? levels[i] : 0.0F;
        levels[i] += std::sqrt(read + photon * light) * normal[i];
    }
}

GOALMOUTH_VECTORISED void clip(float* levels, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) levels[i] = std::min(std::max(levels[i], 0.0F), 255.0F);
}

/// Red, green and blue of an even number of pixels as words Y0 Cb Y1 Cr, the first byte lowest.
GOALMOUTH_VECTORISED void to_ycbcr(const float* r, const float* g, const float* b, std::size_t pairs,
                                   std::int32_t* __restrict luma, std::int32_t* __restrict words) {
    for (std::size_t i = 0; i < 2 * pairs; ++i)
        luma[i] = static_cast<std::int32_t>(y_r * r[i] + y_g * g[i] + y_b * b[i] + 0.5F);
    for (std::size_t i = 0; i < pairs; ++i) {
        const float red = r[2 * i] + r[2 * i + 1];
        const float green = g[2 * i] + g[2 * i + 1];
        const float blue = b[2 * i] + b[2 * i + 1];
        // Pure blue and pure red lie half a level beyond the highest chroma.
        const auto cb = static_cast<std::int32_t>(0.5F * (cb_r * red + cb_g * green + cb_b * blue) + 128.5F);
        const auto cr = static_cast<std::int32_t>(0.5F * (cr_r * red + cr_g * green + cr_b * blue) + 128.5F);
        words[i] = luma[2 * i] | std::min(cb, 255) << 8 | luma[2 * i + 1] << 16 | std::min(cr, 255) << 24;
    }
}

}  // namespace

Sensor::Sensor(const SensorParameters& parameters, const RayTable& rays)
    : width_(rays.camera().width),
      height_(rays.camera().height),
      columns_(static_cast<std::size_t>((width_ + 1) / 2) * 2),
      reach_(parameters.blur > 0.0 ? static_cast<int>(std::ceil(3.5 * parameters.blur)) : 0),
      read_variance_(static_cast<float>(parameters.read_noise * parameters.read_noise)),
      photon_variance_(static_cast<float>(parameters.photon_noise)) {
    assert(width_ > 0 && height_ > 0);
    std::vector<double> weights;
    double sum = 0.0;
    for (int i = -reach_; i <= reach_; ++i) {
        weights.push_back(reach_ == 0 ? 1.0 : std::exp(-0.5 * i * i / (parameters.blur * parameters.blur)));
        sum += weights.back();
    }
    for (const double w : weights) kernel_.push_back(static_cast<float>(w / sum));
    const auto reach = static_cast<std::size_t>(reach_);
    for (auto& row : light_) row.resize(columns_ + 2 * reach);
    rows_.resize((2 * reach + 1) * channels * columns_);
    levels_.resize(channels * columns_);
    luma_.resize(columns_);
    words_.resize(columns_ / 2);
    noise_offset_.resize(static_cast<std::size_t>(height_));
    if (parameters.vignetting > 0.0) {
        for (int v = 0; v < height_; ++v) {
            const RowRays row = rays.row(v);
            for (std::size_t u = 0; u < columns_; ++u) {
                const std::size_t at = std::min(u, static_cast<std::size_t>(width_ - 1));
                const auto x = static_cast<double>(row.x[at]);
                const auto y = static_cast<double>(row.y[at]);
                // The cosine of the ray's angle to the axis is 1 / √(1 + x² + y²).
                vignetting_.push_back(
                    static_cast<float>(std::pow(1.0 + x * x + y * y, -0.5 * parameters.vignetting)));
            }
        }
    }
    if (read_variance_ > 0.0F || photon_variance_ > 0.0F) {
        Random random(0x5e4504ULL);
        for (auto& table : noise_) {
            table.resize(noise_count + columns_);
            for (std::size_t i = 0; i < noise_count; ++i) table[i] = static_cast<float>(random.normal());
            for (std::size_t i = noise_count; i < table.size(); ++i) table[i] = table[i - noise_count];
        }
    }
}

void Sensor::begin(std::uint8_t* out, std::ptrdiff_t stride, const Rgb& gains, Random& random) {
    out_ = out;
    stride_ = stride;
    next_ = 0;
    gains_ = {gains.r, gains.g, gains.b};
    for (auto& offset : noise_offset_) offset = random.index(noise_count);
}

LightRow Sensor::next_row() {
    assert(next_ < height_);
    return {light_[0].data() + reach_, light_[1].data() + reach_, light_[2].data() + reach_, width_};
}

void Sensor::finish_row() {
    blur_along(next_ % (2 * reach_ + 1));
    ++next_;
    const int first = next_ - 1 - reach_;
    const int last = next_ == height_ ? height_ - 1 : first;
    for (int row = std::max(first, 0); row <= last; ++row) {
        blur_across(row);
        expose(row);
        write(row);
    }
}

void Sensor::blur_along(int slot) {
    const auto reach = static_cast<std::size_t>(reach_);
    const auto width = static_cast<std::size_t>(width_);
    float* out = rows_.data() + static_cast<std::size_t>(slot) * channels * columns_;
    std::vector<const float*>& shifted = sources_;
    shifted.resize(2 * reach + 1);
    for (auto& channel : light_) {
        std::fill_n(channel.begin(), reach, channel[reach]);
        std::fill(channel.begin() + static_cast<std::ptrdiff_t>(reach + width), channel.end(),
                  channel[reach + width - 1]);
        for (std::size_t k = 0; k < shifted.size(); ++k) shifted[k] = channel.data() + k;
        blur(shifted.data(), kernel_.data(), reach_, out, columns_);
        out += columns_;
    }
}

void Sensor::blur_across(int row) {
    const int ring = 2 * reach_ + 1;
    sources_.resize(static_cast<std::size_t>(ring));
    for (int k = 0; k < ring; ++k) {
        const int source = std::clamp(row + k - reach_, 0, height_ - 1);
        sources_[static_cast<std::size_t>(k)] =
            rows_.data() + static_cast<std::size_t>(source % ring) * channels * columns_;
    }
    blur(sources_.data(), kernel_.data(), reach_, levels_.data(), channels * columns_);
}

void Sensor::expose(int row) {
    const auto line = static_cast<std::size_t>(row);
    for (std::size_t c = 0; c < channels; ++c) {
        float* levels = levels_.data() + c * columns_;
        const float gain = gains_[c];
        if (!vignetting_.empty()) {
            scale(levels, vignetting_.data() + line * columns_, columns_, gain);
        } else if (gain != 1.0F) {
            for (std::size_t i = 0; i < columns_; ++i) levels[i] *= gain;
        }
        if (!noise_[c].empty())
            add_noise(levels, noise_[c].data() + noise_offset_[line], columns_, read_variance_,
                      photon_variance_);
    }
    clip(levels_.data(), channels * columns_);
}

void Sensor::write(int row) {
    static_assert(std::endian::native == std::endian::little,
                  "a pair is written as one word, its first byte lowest");
    const float* r = levels_.data();
    to_ycbcr(r, r + columns_, r + 2 * columns_, words_.size(), luma_.data(), words_.data());
    std::memcpy(out_ + row * stride_, words_.data(), 4 * words_.size());
}

}  // namespace goalmouth
