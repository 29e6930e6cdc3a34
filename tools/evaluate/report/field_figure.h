#pragma once

#include "core/field/field.h"
#include "core/geometry/pose2.h"
#include "tools/evaluate/report/figure.h"

#include <string>
#include <vector>

namespace goalmouth {

/// The field from above in frame W: its lines, circle and goals as faint series without a name, x to the
/// right, y up, one scale. Paths and points are added to its series.
Figure field_figure(const Field& field, const std::string& title);

/// A path on the field, without markers; broken where two poses lie more than 0.5 m apart, and without the
/// poses less than 2 cm from the last that is drawn. Faint where there are many of them; a name only for the
/// first of a kind.
Series path_series(const std::vector<Pose2>& path, const std::string& name, const SeriesStyle& style);

}  // namespace goalmouth
