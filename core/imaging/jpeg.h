#pragma once

#include "core/imaging/yuyv.h"

#include <cstdint>
#include <span>
#include <vector>

namespace goalmouth {

/// The image of a JPEG file (JFIF: YCbCr of ITU-R BT.601, full range), its chroma brought to 4:2:2 without a
/// detour over RGB. Any chroma subsampling and greyscale are taken. Throws std::runtime_error where the bytes
/// are no such image, are cut off or damaged, or the image is larger than 16384×16384.
YuyvImage yuyv_from_jpeg(std::span<const std::uint8_t> jpeg);

/// A 4:2:2 JPEG of quality 1…100. Throws std::invalid_argument for an empty image, std::runtime_error where
/// the codec fails.
std::vector<std::uint8_t> jpeg_from_yuyv(const YuyvView& image, int quality);

}  // namespace goalmouth
