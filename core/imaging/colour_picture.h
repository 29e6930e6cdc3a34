#pragma once

#include "core/imaging/colour.h"
#include "core/imaging/colour_table.h"
#include "core/imaging/yuyv.h"

#include <opencv2/core.hpp>

// Pictures for people: what a table holds and what it makes of an image. All CV_8UC3, BGR.
namespace goalmouth {

/// The colour a class is drawn in.
cv::Vec3b display_colour(Colour colour);

/// One pixel each, in its class's colour.
cv::Mat segmentation_picture(YuyvView image, const ColourTable& table);

/// The image and its segmentation side by side.
cv::Mat segmentation_beside_image(YuyvView image, const ColourTable& table);

/// The table as slices of the chroma plane (Cb to the right, Cr upwards) at eight luma levels: above, each
/// cell's own colour where it has a class and dimmed where it has none; below, the classes.
cv::Mat table_picture(const ColourTable& table);

}  // namespace goalmouth
