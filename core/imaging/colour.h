#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace goalmouth {

/// Colour classes of the paper's domain (M in section 2). The values stand in tables, messages and logs:
/// never renumber.
enum class Colour : std::uint8_t { unclassified = 0, field = 1, line = 2, ball = 3, goal = 4, robot = 5 };

inline constexpr int colour_count = 6;
inline constexpr std::array<std::string_view, colour_count> colour_names = {"unclassified", "field", "line",
                                                                            "ball",         "goal",  "robot"};

/// One pixel in YCbCr, ITU-R BT.601, full range (as webcams and JPEG deliver it): neutral chroma is 128.
struct Ycbcr {
    std::uint8_t y = 0;
    std::uint8_t cb = 128;
    std::uint8_t cr = 128;
};

}  // namespace goalmouth
