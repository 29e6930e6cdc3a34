#pragma once

#include "core/imaging/yuyv.h"

namespace goalmouth {

/// The image shrunk by a whole number ≥ 1: each pixel the mean of factor × factor, what is left over at the
/// right and lower end falls away.
YuyvImage shrunk(YuyvView image, int factor);

/// Shrunk by the least whole number that makes it no wider than `widest` px.
YuyvImage shrunk_to(YuyvView image, int widest);

}  // namespace goalmouth
