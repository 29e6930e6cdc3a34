#pragma once

#include "core/imaging/colour.h"
#include "core/imaging/yuyv.h"

#include <cstdint>
#include <span>

#include <opencv2/core.hpp>

// Between BGR (OpenCV, 8 bits a channel) and 4:2:2 YCbCr, ITU-R BT.601, full range. 4:2:2 keeps one chroma
// for two pixels: the mean of the two, rounded; the last pixel of an odd row stands alone, repeated in its
// pair.
namespace goalmouth {

Ycbcr ycbcr_from_bgr(const cv::Vec3b& bgr);
cv::Vec3b bgr_from_ycbcr(Ycbcr colour);

/// `bgr` is CV_8UC3, may be a part of a larger image; throws std::invalid_argument for another type.
YuyvImage yuyv_from_bgr(const cv::Mat& bgr);
/// The same into `to`, which has yuyv_row_bytes(columns)·rows bytes; throws std::invalid_argument for another
/// size.
void yuyv_from_bgr(const cv::Mat& bgr, std::span<std::uint8_t> to);

/// CV_8UC3; empty for an empty image.
cv::Mat bgr_from_yuyv(YuyvView image);

}  // namespace goalmouth
