#pragma once

#include "core/imaging/yuyv.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace goalmouth {

/// The image of a JPEG file (JFIF: YCbCr of ITU-R BT.601, full range), its chroma brought to 4:2:2 without a
/// detour over RGB. Any chroma subsampling and greyscale are taken. Throws std::runtime_error where the bytes
/// are no such image, are cut off or damaged, or the image is larger than 16384×16384.
YuyvImage yuyv_from_jpeg(std::span<const std::uint8_t> jpeg);

/// The same for many images, into memory of the caller's. Keeps its own, so that images of one size cost the
/// heap nothing after the first; gives it back for a much smaller one. Reads the header anew in each call:
/// the bytes must not change meanwhile, nor between the two calls.
class JpegDecoder {
  public:
    struct Size {
        int width = 0;
        int height = 0;
    };

    JpegDecoder();
    ~JpegDecoder();
    JpegDecoder(const JpegDecoder&) = delete;
    JpegDecoder& operator=(const JpegDecoder&) = delete;

    /// How large the image will be. Throws as yuyv_from_jpeg().
    Size size_of(std::span<const std::uint8_t> jpeg);
    /// Rows packed: `to` has yuyv_row_bytes(width)·height bytes. Throws as yuyv_from_jpeg(), and
    /// std::invalid_argument where `to` has another size.
    void decode(std::span<const std::uint8_t> jpeg, std::span<std::uint8_t> to);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A 4:2:2 JPEG of quality 1…100. Throws std::invalid_argument for an empty image, std::runtime_error where
/// the codec fails.
std::vector<std::uint8_t> jpeg_from_yuyv(const YuyvView& image, int quality);

}  // namespace goalmouth
