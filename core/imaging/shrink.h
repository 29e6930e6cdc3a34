#pragma once

#include "core/imaging/yuyv.h"

namespace goalmouth {

/// The least whole number that, dividing it, makes an image no wider than `widest` px; less where the image
/// is too low for that.
int shrink_factor(YuyvView image, int widest);

/// The image shrunk by a whole number ≥ 1 (at most half its width and its height): each pixel the mean of
/// factor × factor; what is left over at the right and lower end falls away.
YuyvImage shrunk(YuyvView image, int factor);

}  // namespace goalmouth
