#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace goalmouth {

/// One of the paper's 18 places (section 5, Evaluation Metrics): the camera in line with the right post, at a
/// distance along the ground, the body leaning to a side.
struct EvaluationCell {
    int distance_cm = 0;  // camera centre to the post's axis
    int tilt_deg = 0;     // to either side

    double distance() const { return distance_cm / 100.0; }              // m
    double tilt() const { return tilt_deg * std::numbers::pi / 180.0; }  // rad
    bool operator==(const EvaluationCell&) const = default;
};

/// Ids of the posts of the opponents' goal, as Field::posts().
inline constexpr int post_in_line = 3;
inline constexpr int second_post = 2;

inline constexpr std::array<int, 6> cell_distances_cm = {60, 150, 300, 350, 530, 600};
inline constexpr std::array<int, 3> cell_tilts_deg = {0, 10, 20};
inline constexpr int cell_count = static_cast<int>(cell_distances_cm.size() * cell_tilts_deg.size());

/// Cell 0 … cell_count − 1: all distances at the first tilt, then at the next.
inline EvaluationCell evaluation_cell(int cell) {
    const auto i = static_cast<std::size_t>(cell);
    return {cell_distances_cm[i % cell_distances_cm.size()], cell_tilts_deg[i / cell_distances_cm.size()]};
}

inline constexpr int most_frames_per_cell = 1 << 20;

/// Number of a frame among all that a scene can have, however many of a cell are asked for: what is drawn at
/// random for it follows from this number.
inline std::int64_t frame_number(int cell, int index) {
    return static_cast<std::int64_t>(cell) * most_frames_per_cell + index;
}

}  // namespace goalmouth
