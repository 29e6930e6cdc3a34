#pragma once

#include "core/colour_learning/light_tracker.h"
#include "core/imaging/yuyv.h"

#include <optional>

#include <Eigen/Core>

namespace goalmouth {

/// The field in whatever light, for when the table no longer finds it: where `reference` [levels of red,
/// green, blue] is what it looked like, some light between candle and sky, darker or brighter, must turn that
/// into the colour of most of the picture's lower half. Nothing where none does, and where light would leave
/// of the field's colour too little to be told from grey.
std::optional<FieldLook> search_field(YuyvView image, const Eigen::Vector3d& reference,
                                      const LightTrackerParameters& parameters);

}  // namespace goalmouth
