#include "core/imaging/chroma_shift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace goalmouth {
namespace {

constexpr int unit = 256;  // of weights

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
    for (int y = 0; y < image.height; ++y) {
        const std::uint8_t* from = image.row(y);
        std::uint8_t* to = moved.data.data() + static_cast<std::ptrdiff_t>(y) * moved.stride();
        const auto set = [&](int i, const std::array<const std::uint8_t*, 4>& p) {
            const auto blend = [&](std::size_t part) {
                int sum = unit / 2;
                for (std::size_t k = 0; k < p.size(); ++k) sum += weights[k] * p[k][part];
                return static_cast<std::uint8_t>(std::clamp(sum / unit, 0, 255));
            };
            to[4 * i] = from[4 * i];
            to[4 * i + 1] = blend(1);
            to[4 * i + 2] = from[4 * i + 2];
            to[4 * i + 3] = blend(3);
        };
        const auto at = [&](int i) { return from + 4 * std::clamp(i, 0, pairs - 1); };
        const auto set_at_border = [&](int i) {
            const int k = i + whole;
            set(i, {at(k - 1), at(k), at(k + 1), at(k + 2)});
        };
        for (int i = 0; i < first; ++i) set_at_border(i);
        for (int i = first; i < last; ++i) {
            const std::uint8_t* p = from + 4 * (i + whole);
            set(i, {p - 4, p, p + 4, p + 8});
        }
        for (int i = last; i < pairs; ++i) set_at_border(i);
    }
}

}  // namespace goalmouth
