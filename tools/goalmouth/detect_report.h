#pragma once

#include "tools/goalmouth/image_chain.h"

#include <string>

#include <nlohmann/json.hpp>

namespace goalmouth {

/// {"file", "width", "height",
///  "posts": [{"left": [[x_top, y_top], [x_base, y_base]], "right": …, "distance_m", "bearing_rad", …}],
///  "border": [[x, y] …], "milliseconds": {stage: …}}
/// distance_m is null where the post has none.
nlohmann::ordered_json image_report(const std::string& file, const ImageResult& result);

/// The same for people, some lines.
std::string image_summary(const std::string& file, const ImageResult& result);

}  // namespace goalmouth
