#pragma once

#include "core/imaging/yuyv.h"

namespace goalmouth {

/// The picture with its chroma `shift` px farther left: where a camera shows it that far right of its luma,
/// each comes to lie on the other. Between pairs it is interpolated (Catmull–Rom), beyond the border the
/// border's goes on. `moved` keeps its memory from picture to picture.
void move_chroma_left(YuyvView image, double shift, YuyvImage& moved);

}  // namespace goalmouth
