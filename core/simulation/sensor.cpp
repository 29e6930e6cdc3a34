#include "core/simulation/sensor.h"

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

constexpr std::uint32_t noise_pairs = 1U << 15U;

/// Rounds to levels of 0…255.
void quantise(const float* values, std::size_t count, float offset, std::int32_t* levels) {
    const float rounding = offset + 0.5F;
    for (std::size_t i = 0; i < count; ++i) {
        const auto level = static_cast<std::int32_t>(values[i] + rounding);
        levels[i] = std::min(std::max(level, 0), 255);
    }
}

}  // namespace

Sensor::Sensor(const SensorParameters& parameters, int width, int height)
    : width_(width),
      height_(height),
      pairs_((width + 1) / 2),
      reach_(parameters.blur > 0.0 ? static_cast<int>(std::ceil(3.5 * parameters.blur)) : 0),
      noise_(static_cast<float>(parameters.read_noise)) {
    assert(width > 0 && height > 0);
    double sum = 0.0;
    std::vector<double> weights;
    for (int i = -reach_; i <= reach_; ++i) {
        weights.push_back(reach_ == 0 ? 1.0 : std::exp(-0.5 * i * i / (parameters.blur * parameters.blur)));
        sum += weights.back();
    }
    for (const double w : weights) kernel_.push_back(static_cast<float>(w / sum));
    for (std::size_t i = 0; i <= kernel_.size(); ++i) {
        const float left = i > 0 ? kernel_[i - 1] : 0.0F;
        const float right = i < kernel_.size() ? kernel_[i] : 0.0F;
        chroma_kernel_.push_back(0.5F * (left + right));
    }
    const auto p = static_cast<std::size_t>(pairs_);
    const auto reach = static_cast<std::size_t>(reach_);
    for (auto* plane : {&r_, &g_, &b_}) plane->resize(2 * p);
    luma_.resize(2 * p + 2 * reach);
    for (auto* half : {&cb_even_, &cb_odd_, &cr_even_, &cr_odd_}) half->resize(p + reach + 2);
    rows_.resize((2 * reach + 1) * 4 * p);
    sum_.resize(4 * p);
    levels_.resize(4 * p);
    words_.resize(p);
    noise_offset_.resize(static_cast<std::size_t>(height));
    if (noise_ > 0.0F) {
        // Noise of red, green and blue, carried through the colour transform and the pair's mean.
        Random random(0x5e4504ULL);
        const std::size_t size = noise_pairs + p;
        noise_y_.resize(2 * size);
        noise_cb_.resize(size);
        noise_cr_.resize(size);
        for (std::size_t i = 0; i < noise_pairs; ++i) {
            for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
                const auto r = static_cast<float>(random.normal());
                const auto g = static_cast<float>(random.normal());
                const auto b = static_cast<float>(random.normal());
                noise_y_[2 * i + k] = y_r * r + y_g * g + y_b * b;
                noise_cb_[i] += 0.5F * (cb_r * r + cb_g * g + cb_b * b);
                noise_cr_[i] += 0.5F * (cr_r * r + cr_g * g + cr_b * b);
            }
        }
        for (std::size_t i = noise_pairs; i < size; ++i) {
            noise_y_[2 * i] = noise_y_[2 * (i - noise_pairs)];
            noise_y_[2 * i + 1] = noise_y_[2 * (i - noise_pairs) + 1];
            noise_cb_[i] = noise_cb_[i - noise_pairs];
            noise_cr_[i] = noise_cr_[i - noise_pairs];
        }
    }
}

void Sensor::begin(std::uint8_t* out, std::ptrdiff_t stride, Random& random) {
    out_ = out;
    stride_ = stride;
    next_ = 0;
    for (auto& offset : noise_offset_) offset = random.index(noise_pairs);
}

LightRow Sensor::next_row() {
    assert(next_ < height_);
    return {r_.data(), g_.data(), b_.data(), width_};
}

void Sensor::finish_row() {
    const int ring = 2 * reach_ + 1;
    blur_along(next_ % ring);
    ++next_;
    if (next_ > reach_) write_row(next_ - 1 - reach_);
    if (next_ == height_)
        for (int row = std::max(0, height_ - reach_); row < height_; ++row) write_row(row);
}

void Sensor::blur_along(int slot) {
    const auto pairs = static_cast<std::size_t>(pairs_);
    const auto reach = static_cast<std::size_t>(reach_);
    const std::size_t width = 2 * pairs;
    const auto last = static_cast<std::size_t>(width_ - 1);
    if (last + 1 < width) {
        r_[last + 1] = r_[last];
        g_[last + 1] = g_[last];
        b_[last + 1] = b_[last];
    }
    // What lies beyond the image is taken to be like its rim.
    const float* r = r_.data();
    const float* g = g_.data();
    const float* b = b_.data();
    float* luma = luma_.data() + reach;
    for (std::size_t i = 0; i < width; ++i) luma[i] = y_r * r[i] + y_g * g[i] + y_b * b[i];
    for (std::size_t i = 0; i < reach; ++i) {
        luma_[i] = luma[0];
        luma[width + i] = luma[width - 1];
    }
    // even[k] and odd[k] are pixels 2(k − lead) and 2(k − lead) + 1.
    const std::size_t lead = (reach + 1) / 2;
    float* cb_even = cb_even_.data() + lead;
    float* cb_odd = cb_odd_.data() + lead;
    float* cr_even = cr_even_.data() + lead;
    float* cr_odd = cr_odd_.data() + lead;
    for (std::size_t i = 0; i < pairs; ++i) {
        cb_even[i] = cb_r * r[2 * i] + cb_g * g[2 * i] + cb_b * b[2 * i];
        cb_odd[i] = cb_r * r[2 * i + 1] + cb_g * g[2 * i + 1] + cb_b * b[2 * i + 1];
    }
    for (std::size_t i = 0; i < pairs; ++i) {
        cr_even[i] = cr_r * r[2 * i] + cr_g * g[2 * i] + cr_b * b[2 * i];
        cr_odd[i] = cr_r * r[2 * i + 1] + cr_g * g[2 * i + 1] + cr_b * b[2 * i + 1];
    }
    for (std::size_t i = 0; i < lead; ++i) {
        cb_even_[i] = cb_odd_[i] = cb_even[0];
        cr_even_[i] = cr_odd_[i] = cr_even[0];
    }
    for (std::size_t i = pairs + lead; i < cb_even_.size(); ++i) {
        cb_even_[i] = cb_odd_[i] = cb_odd[pairs - 1];
        cr_even_[i] = cr_odd_[i] = cr_odd[pairs - 1];
    }

    float* row = rows_.data() + static_cast<std::size_t>(slot) * 4 * pairs;
    float* blurred_cb = row + width;
    float* blurred_cr = blurred_cb + pairs;
    // Both kernels are symmetric: two taps at a time.
    const float middle = kernel_[reach];
    for (std::size_t i = 0; i < width; ++i) row[i] = middle * luma[i];
    for (std::size_t k = 0; k < reach; ++k) {
        const float weight = kernel_[k];
        const float* one = luma_.data() + k;
        const float* other = luma_.data() + (2 * reach - k);
        for (std::size_t i = 0; i < width; ++i) row[i] += weight * (one[i] + other[i]);
    }
    std::fill(blurred_cb, blurred_cb + 2 * pairs, 0.0F);
    for (std::size_t k = 0; k <= reach; ++k) {
        const float weight = chroma_kernel_[k];
        // Pixels 2i + k − reach and 2i + 1 + reach − k of pair i: one is even, the other odd.
        const auto low = static_cast<std::ptrdiff_t>(k) - static_cast<std::ptrdiff_t>(reach);
        const auto high = 1 - low;
        const bool low_is_odd = (low & 1) != 0;
        const std::ptrdiff_t even = (low_is_odd ? high : low) / 2;
        const std::ptrdiff_t odd = ((low_is_odd ? low : high) - 1) / 2;
        for (std::size_t i = 0; i < pairs; ++i) {
            const auto at = static_cast<std::ptrdiff_t>(i);
            blurred_cb[i] += weight * (cb_even[at + even] + cb_odd[at + odd]);
            blurred_cr[i] += weight * (cr_even[at + even] + cr_odd[at + odd]);
        }
    }
}

void Sensor::write_row(int row) {
    const auto pairs = static_cast<std::size_t>(pairs_);
    const std::size_t width = 2 * pairs;
    const int ring = 2 * reach_ + 1;
    float* sum = sum_.data();
    const auto blurred = [&](int source) {
        return rows_.data() + static_cast<std::size_t>(std::clamp(source, 0, height_ - 1) % ring) * 4 * pairs;
    };
    const float middle = kernel_[static_cast<std::size_t>(reach_)];
    const float* here = blurred(row);
    for (std::size_t i = 0; i < 4 * pairs; ++i) sum[i] = middle * here[i];
    for (int k = 1; k <= reach_; ++k) {
        const float weight = kernel_[static_cast<std::size_t>(reach_ - k)];
        const float* above = blurred(row - k);
        const float* below = blurred(row + k);
        for (std::size_t i = 0; i < 4 * pairs; ++i) sum[i] += weight * (above[i] + below[i]);
    }
    float* y = sum;
    float* cb = sum + width;
    float* cr = cb + pairs;
    if (noise_ > 0.0F) {
        const float noise = noise_;
        const std::size_t start = noise_offset_[static_cast<std::size_t>(row)];
        const float* ny = noise_y_.data() + 2 * start;
        const float* ncb = noise_cb_.data() + start;
        const float* ncr = noise_cr_.data() + start;
        for (std::size_t i = 0; i < width; ++i) y[i] += noise * ny[i];
        for (std::size_t i = 0; i < pairs; ++i) {
            cb[i] += noise * ncb[i];
            cr[i] += noise * ncr[i];
        }
    }
    std::int32_t* levels = levels_.data();
    quantise(y, width, 0.0F, levels);
    quantise(cb, width, 128.0F, levels + width);  // and Cr, which follows
    const std::int32_t* level_cb = levels + width;
    const std::int32_t* level_cr = level_cb + pairs;
    static_assert(std::endian::native == std::endian::little,
                  "a pair is written as one word, its first byte lowest");
    std::int32_t* words = words_.data();
    for (std::size_t i = 0; i < pairs; ++i)
        words[i] = levels[2 * i] | level_cb[i] << 8 | levels[2 * i + 1] << 16 | level_cr[i] << 24;
    std::memcpy(out_ + row * stride_, words, 4 * pairs);
}

}  // namespace goalmouth
