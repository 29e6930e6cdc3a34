#pragma once

#include "core/imaging/yuyv.h"

namespace goalmouth {

/// The picture with each column blurred by (1, 4, 6, 4, 1)/16, the border's rows going on beyond it: noise of
/// single pixels falls to about a half, edges that stand upright stay as sharp as they were. `blurred` keeps
/// its memory from picture to picture.
void blur_vertically(YuyvView image, YuyvImage& blurred);

}  // namespace goalmouth
