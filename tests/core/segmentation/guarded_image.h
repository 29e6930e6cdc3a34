#pragma once

#include "core/imaging/yuyv.h"

#include <cstddef>
#include <cstdint>

namespace goalmouth::test {

/// An image whose last pixel ends where readable memory ends, with a gap between its rows: what reads a byte
/// behind its pixels stops the program. Pixels are zero at first.
class GuardedImage {
  public:
    GuardedImage(int width, int height, int gap = 0);
    ~GuardedImage();
    GuardedImage(const GuardedImage&) = delete;
    GuardedImage& operator=(const GuardedImage&) = delete;

    int width() const { return width_; }
    int height() const { return height_; }
    std::uint8_t* row(int y) { return pixels_ + static_cast<std::ptrdiff_t>(y) * stride_; }
    YuyvView view() const { return {pixels_, width_, height_, stride_}; }

  private:
    int width_;
    int height_;
    int stride_;
    void* memory_;
    std::size_t size_;
    std::uint8_t* pixels_;
};

}  // namespace goalmouth::test
