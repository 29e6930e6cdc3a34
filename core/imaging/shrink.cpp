#include "core/imaging/shrink.h"

#include <algorithm>
#include <cstddef>

namespace goalmouth {

namespace {

/// Mean of `side` × `side` bytes, `step` apart in a row, rounded.
std::uint8_t mean(const std::uint8_t* from, int stride, int side, int step) {
    int sum = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) sum += from[static_cast<std::ptrdiff_t>(y) * stride + x * step];
    const int all = side * side;
    return static_cast<std::uint8_t>((sum + all / 2) / all);
}

int largest_factor(YuyvView image) {
    return std::max(1, std::min(image.width / 2, image.height));
}

}  // namespace

int shrink_factor(YuyvView image, int widest) {
    return std::clamp((image.width + widest - 1) / widest, 1, largest_factor(image));
}

YuyvImage shrunk(YuyvView image, int factor) {
    factor = std::clamp(factor, 1, largest_factor(image));
    if (factor == 1) {
        YuyvImage copy(image.width, image.height);
        for (int y = 0; y < image.height; ++y)
            std::copy_n(image.row(y), copy.stride(),
                        copy.data.begin() + static_cast<std::ptrdiff_t>(y) * copy.stride());
        return copy;
    }
    YuyvImage out(image.width / (2 * factor) * 2, image.height / factor);
    for (int y = 0; y < out.height; ++y) {
        const std::uint8_t* block = image.row(y * factor);
        std::uint8_t* to = out.data.data() + static_cast<std::ptrdiff_t>(y) * out.stride();
        for (int pair = 0; pair < out.width / 2; ++pair, to += 4, block += 4 * factor) {
            to[0] = mean(block, image.stride, factor, 2);
            to[1] = mean(block + 1, image.stride, factor, 4);
            to[2] = mean(block + 2 * factor, image.stride, factor, 2);
            to[3] = mean(block + 3, image.stride, factor, 4);
        }
    }
    return out;
}

}  // namespace goalmouth
