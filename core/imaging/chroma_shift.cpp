#include "core/imaging/chroma_shift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace goalmouth {
namespace {

constexpr int shift_of_unit = 6, unit = 1 << shift_of_unit;  // of weights: sums of four bytes fit 16 bits

/// Catmull–Rom's, of the pair before, both that a place lies between, and the one after; sum: unit.
std::array<int, 4> cubic_weights(double share) {
    const double t = share, t2 = t * t, t3 = t2 * t;
    std::array<int, 4> weights{};
    weights[0] = static_cast<int>(std::lround(unit * 0.5 * (-t + 2.0 * t2 - t3)));
    weights[2] = static_cast<int>(std::lround(unit * 0.5 * (t + 4.0 * t2 - 3.0 * t3)));
    weights[3] = static_cast<int>(std::lround(unit * 0.5 * (t3 - t2)));
    weights[1] = unit - weights[0] - weights[2] - weights[3];
    return weights;
}

}  // namespace

void move_chroma_left(YuyvView image, double shift, YuyvImage& moved) {
    moved.width = image.width;
    moved.height = image.height;
    moved.data.resize(static_cast<std::size_t>(moved.stride()) * static_cast<std::size_t>(image.height));
    const int pairs = (image.width + 1) / 2;
    const double by = std::clamp(0.5 * shift, -1.0 * pairs, 1.0 * pairs);  // pairs
    const int whole = static_cast<int>(std::floor(by));
    const std::array<int, 4> weights = cubic_weights(by - whole);
    // Pairs of which all that they are made of lies in the picture.
    const int first = std::clamp(1 - whole, 0, pairs), last = std::clamp(pairs - 2 - whole, first, pairs);
    const auto short_weight = [&](std::size_t k) { return static_cast<std::int16_t>(weights[k]); };
    const std::int16_t w0 = short_weight(0), w1 = short_weight(1), w2 = short_weight(2), w3 = short_weight(3);
    const auto blend = [=](std::int16_t a, std::int16_t b, std::int16_t c, std::int16_t d) {
        const auto sum = static_cast<std::int16_t>(w0 * a + w1 * b + w2 * c + w3 * d + unit / 2);
        const auto mean = static_cast<std::int16_t>(sum >> shift_of_unit);
        return static_cast<std::uint8_t>(std::clamp<std::int16_t>(mean, 0, 255));
    };
    for (int y = 0; y < image.height; ++y) {
        const std::uint8_t* from = image.row(y);
        std::uint8_t* to = moved.data.data() + static_cast<std::ptrdiff_t>(y) * moved.stride();
        const std::ptrdiff_t away = 4 * static_cast<std::ptrdiff_t>(whole);
        // All bytes alike, and luma again after that: this the compiler makes vectors of.
        for (std::ptrdiff_t i = 4 * first; i < 4 * last; ++i)
            to[i] = blend(from[i + away - 4], from[i + away], from[i + away + 4], from[i + away + 8]);
        for (std::ptrdiff_t i = 4 * first; i < 4 * last; i += 2) to[i] = from[i];
        const auto set_at_border = [&](int pair) {
            for (int part = 0; part < 4; ++part) {
                const auto at = [&](int i) {
                    return from[4 * std::clamp(pair + whole + i, 0, pairs - 1) + part];
                };
                to[4 * pair + part] =
                    part % 2 == 0 ? from[4 * pair + part] : blend(at(-1), at(0), at(1), at(2));
            }
        };
        for (int pair = 0; pair < first; ++pair) set_at_border(pair);
        for (int pair = last; pair < pairs; ++pair) set_at_border(pair);
    }
}

}  // namespace goalmouth
