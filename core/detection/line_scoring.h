#pragma once

#include "core/detection/point_grid.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace goalmouth {

/// Samples of two points, one for each hypothesis; so many are worked on at a time.
struct LineSamples {
    static constexpr std::size_t most = 64;

    alignas(64) std::array<GridPoint, most> first{};
    alignas(64) std::array<GridPoint, most> second{};
    std::size_t count = 0;
};

struct SupportBounds {
    std::uint32_t most = 0;  // the largest
    std::size_t first = 0;   // the first sample that has it
};

/// For each sample the number of points that may be nearer to the line through it than the distance that
/// `near` is for: no fewer than Line::distance() finds, and hardly more. All points for a sample too short to
/// tell. Room for LineSamples::most in `support`, and for as many as there are points in `rounded`, which is
/// written over.
SupportBounds bound_support(const LineSamples& samples, std::int16_t near, const GridPoint* points,
                            std::size_t count, GridPoint* rounded, std::uint32_t* support);

}  // namespace goalmouth
