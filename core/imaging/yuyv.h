#pragma once

#include "core/imaging/colour.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace goalmouth {

/// A 4:2:2 image somebody else owns: bytes Y0 Cb Y1 Cr for each pair of pixels. A row of odd width holds one
/// pixel more than it shows, so every pixel has its pair. Pixel (0,0) is the top-left one.
struct YuyvView {
    const std::uint8_t* data = nullptr;
    int width = 0;   // px
    int height = 0;  // px
    int stride = 0;  // bytes from row to row, ≥ yuyv_row_bytes(width)

    const std::uint8_t* row(int y) const { return data + static_cast<std::ptrdiff_t>(y) * stride; }
    Ycbcr at(int x, int y) const {
        assert(x >= 0 && x < width && y >= 0 && y < height);
        const std::uint8_t* pair = row(y) + 4 * (x / 2);
        return {pair[2 * (x & 1)], pair[1], pair[3]};
    }
    bool empty() const { return width <= 0 || height <= 0; }
};

inline constexpr int yuyv_row_bytes(int width) {
    return 4 * ((width + 1) / 2);
}

/// A 4:2:2 image that owns its pixels, rows packed without gaps.
struct YuyvImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> data;

    YuyvImage() = default;
    YuyvImage(int w, int h)
        : width(w),
          height(h),
          data(static_cast<std::size_t>(yuyv_row_bytes(w)) * static_cast<std::size_t>(h)) {}
    int stride() const { return yuyv_row_bytes(width); }
    YuyvView view() const { return {data.data(), width, height, stride()}; }
};

}  // namespace goalmouth
