#include "core/refinement/camera_response.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

/// BT.601 in full range, as pictures are read everywhere (core/imaging/conversion.h).
Eigen::Vector3f rgb_of(const PairColour& c) {
    return {c[0] + 1.402F * c[2], c[0] - 0.344136F * c[1] - 0.714136F * c[2], c[0] + 1.772F * c[1]};
}

PairColour colour_of(const Eigen::Vector3f& rgb) {
    const float luma = 0.299F * rgb[0] + 0.587F * rgb[1] + 0.114F * rgb[2];
    return {luma, (rgb[2] - luma) / 1.772F, (rgb[0] - luma) / 1.402F};
}

float level_of_light(float light) {
    const float l = std::clamp(light, 0.0F, 1.0F);
    return l <= 0.0031308F ? 12.92F * l : 1.055F * std::pow(l, 1.0F / 2.4F) - 0.055F;
}

}  // namespace

float light_of_level(float level) {
    const float v = std::clamp(level, 0.0F, 1.0F);
    return v * (light_factors[0] + v * (light_factors[1] + v * light_factors[2]));
}

float grey_as_read(float level, CameraResponse response) {
    return response == CameraResponse::srgb ? 255.0F * light_of_level(level / 255.0F) : level;
}

PairColour light_of_level(const PairColour& level) {
    Eigen::Vector3f rgb = rgb_of(level);
    for (float& c : rgb) c = 255.0F * light_of_level(c / 255.0F);
    return colour_of(rgb);
}

PairColour level_of_light(const PairColour& light) {
    Eigen::Vector3f rgb = rgb_of(light);
    for (float& c : rgb) c = 255.0F * level_of_light(c / 255.0F);
    return colour_of(rgb);
}

PairColour PairRow::light(int pair) const {
    const std::uint8_t* at = row_ + 4 * pair;
    const std::uint8_t* before = pair > 0 ? at - 4 : at;
    const std::uint8_t* after = pair + 1 < pairs_ ? at + 4 : at;
    const auto half_step = [&](int k) { return 0.125F * static_cast<float>(after[k] - before[k]); };
    const float cb = static_cast<float>(at[1]) - 128.0F, cr = static_cast<float>(at[3]) - 128.0F;
    const PairColour first(static_cast<float>(at[0]), cb - half_step(1), cr - half_step(3));
    const PairColour second(static_cast<float>(at[2]), cb + half_step(1), cr + half_step(3));
    return 0.5F * (light_of_level(first) + light_of_level(second));
}

}  // namespace goalmouth
