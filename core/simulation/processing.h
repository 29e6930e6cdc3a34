#pragma once

#include "core/imaging/yuyv.h"
#include "core/parameters/parameters.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace goalmouth {

/// What a webcam does to a frame before it sends it.
struct ProcessingParameters {
    double sharpening = 0.0;
    int mjpeg_quality = 0;
};

template <class Visitor>
void describe_parameters(Visitor& v, ProcessingParameters& p) {
    v("sharpening", p.sharpening, Range{0, 4}, "1",
      "luma is moved away from the mean of its 3x3 neighbourhood by this share of the difference; 0: off");
    v("mjpeg_quality", p.mjpeg_quality, Range{0, 100}, "1",
      "the frame is sent as a JPEG of this quality; 0: raw");
}

/// Sharpens, then compresses and decompresses. What lies beyond the rim is taken to be like it.
class Processing {
  public:
    Processing(const ProcessingParameters& parameters, int width, int height);
    /// In place; YUYV rows `stride` bytes apart. Throws std::runtime_error where the JPEG codec fails.
    void run(std::uint8_t* frame, std::ptrdiff_t stride);

  private:
    void sharpen(std::uint8_t* frame, std::ptrdiff_t stride);
    void compress(std::uint8_t* frame, std::ptrdiff_t stride);

    ProcessingParameters parameters_;
    int width_, height_;
    std::vector<std::uint8_t> luma_;  // three rows, before sharpening
};

}  // namespace goalmouth
