#pragma once

#include "tools/goalmouth/image_chain.h"

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace goalmouth {

/// {"file", "width", "height",
///  "posts": [{"left": [[x_top, y_top], [x_base, y_base]], "right": …, "distance_m", "sigma_m",
///  "bearing_rad",
///             "refined": true, …, "refinement": {"quality", "reason", "rows", …, "cues": […]}}],
///  "border": [[x, y] …], "milliseconds": {stage: …}}
/// distance_m and sigma_m are null where the post has none; refinement stands where the graph refines.
nlohmann::ordered_json image_report(const std::string& file, const ImageResult& result);

/// The same for people, some lines.
std::string image_summary(const std::string& file, const ImageResult& result);

}  // namespace goalmouth
