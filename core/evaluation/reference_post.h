#pragma once

#include <Eigen/Core>

namespace goalmouth {

/// A goalpost that is known to be in a picture, from geometry or from a person's eye: its two side edges as
/// straight lines in the picture as it is (px, lens distortion and all), over the length that lies inside
/// the picture.
struct ReferencePost {
    Eigen::Vector2d left_top, left_base, right_top, right_base;
    bool counts = true;  // false: too little of it can be seen to ask for it
};

}  // namespace goalmouth
