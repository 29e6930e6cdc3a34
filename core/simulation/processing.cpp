#include "core/simulation/processing.h"

#include "core/imaging/jpeg.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace goalmouth {

Processing::Processing(const ProcessingParameters& parameters, int width, int height)
    : parameters_(parameters), width_(width), height_(height) {
    assert(width > 0 && height > 0);
    if (parameters_.sharpening > 0.0) luma_.resize(3 * (static_cast<std::size_t>(width) + 2));
}

void Processing::run(std::uint8_t* frame, std::ptrdiff_t stride) {
    if (parameters_.sharpening > 0.0) sharpen(frame, stride);
    if (parameters_.mjpeg_quality > 0) compress(frame, stride);
}

void Processing::sharpen(std::uint8_t* frame, std::ptrdiff_t stride) {
    const auto width = static_cast<std::size_t>(width_);
    // Three rows of luma as they were before, with one pixel like the rim on either side.
    const auto line = [&](int row) { return luma_.data() + static_cast<std::size_t>(row % 3) * (width + 2); };
    const auto read = [&](int row) {
        const std::uint8_t* from = frame + row * stride;
        std::uint8_t* to = line(row);
        for (std::size_t x = 0; x < width; ++x) to[x + 1] = from[2 * x];
        to[0] = to[1];
        to[width + 1] = to[width];
    };
    const auto share = static_cast<float>(parameters_.sharpening);
    const float whole = 1.0F + share;
    const float ninth = share / 9.0F;
    read(0);
    for (int row = 0; row < height_; ++row) {
        if (row + 1 < height_) read(row + 1);
        const std::uint8_t* above = line(std::max(row - 1, 0));
        const std::uint8_t* here = line(row);
        const std::uint8_t* below = line(std::min(row + 1, height_ - 1));
        std::uint8_t* out = frame + row * stride;
        for (std::size_t x = 0; x < width; ++x) {
            const int sum = above[x] + above[x + 1] + above[x + 2] + here[x] + here[x + 1] + here[x + 2] +
                            below[x] + below[x + 1] + below[x + 2];
            const float level = whole * static_cast<float>(here[x + 1]) - ninth * static_cast<float>(sum);
            out[2 * x] = static_cast<std::uint8_t>(std::clamp(level, 0.0F, 255.0F) + 0.5F);
        }
        if (width % 2 != 0) out[2 * width] = out[2 * width - 2];
    }
}

void Processing::compress(std::uint8_t* frame, std::ptrdiff_t stride) {
    const YuyvView raw{frame, width_, height_, static_cast<int>(stride)};
    const YuyvImage sent = yuyv_from_jpeg(jpeg_from_yuyv(raw, parameters_.mjpeg_quality));
    const auto bytes = static_cast<std::size_t>(yuyv_row_bytes(width_));
    for (int row = 0; row < height_; ++row) std::memcpy(frame + row * stride, sent.view().row(row), bytes);
}

}  // namespace goalmouth
