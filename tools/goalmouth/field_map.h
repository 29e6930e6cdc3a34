#pragma once

#include "core/field/field.h"
#include "core/geometry/pose2.h"
#include "core/localisation/belief.h"
#include "core/localisation/particle.h"

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

namespace goalmouth {

class DemoMonitor;

/// What a map shows on top of the field; what is empty is left out, of the legend too.
struct FieldMap {
    std::vector<Pose2> true_path;       // frame W, in order of time
    std::vector<Pose2> estimated_path;  // frame W, in order of time
    std::optional<PoseEstimate> pose;   // the belief at the end: hypotheses with their 2 σ ellipses
    Particles particles;
};

/// The field from above, x to the right and y up, with goals, a scale in metres and a legend, as a BGR
/// picture `width` px wide (at least 400). A path is broken where the robot was moved faster than it walks.
cv::Mat draw_field_map(const Field& field, const FieldMap& map, int width = 1280);

/// The map of all that a demonstration saw.
cv::Mat field_map_of(const Field& field, const DemoMonitor& monitor);

}  // namespace goalmouth
