#include "core/imaging/vertical_blur.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace goalmouth {

void blur_vertically(YuyvView image, YuyvImage& blurred) {
    blurred.width = image.width;
    blurred.height = image.height;
    const auto bytes = static_cast<std::size_t>(blurred.stride());
    blurred.data.resize(bytes * static_cast<std::size_t>(image.height));
    for (int y = 0; y < image.height; ++y) {
        std::array<const std::uint8_t*, 5> rows;
        for (int k = 0; k < 5; ++k)
            rows[static_cast<std::size_t>(k)] = image.row(std::clamp(y + k - 2, 0, image.height - 1));
        std::uint8_t* to = blurred.data.data() + bytes * static_cast<std::size_t>(y);
        for (std::size_t i = 0; i < bytes; ++i)
            to[i] = static_cast<std::uint8_t>(
                (rows[0][i] + rows[4][i] + 4 * (rows[1][i] + rows[3][i]) + 6 * rows[2][i] + 8) / 16);
    }
}

}  // namespace goalmouth
