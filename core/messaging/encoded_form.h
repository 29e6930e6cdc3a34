#pragma once

#include "core/messaging/validation.h"

#include <cstdint>
#include <span>

namespace goalmouth {

/// Whether the lengths inside an encoded message (hash included) add up to its size, and its strings are C
/// strings. Generated decoders believe each length: they allocate gigabytes for a forged count and read
/// beyond the buffer where the count times the element size overflows an int. So this is asked before every
/// decode. The message argument only picks the type. The layouts restate lcmtypes/*.lcm; a test holds them
/// against the generated encoders.
bool lengths_add_up(const intrinsics_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const camera_info_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const image_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const image_slice_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const segments_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const border_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const candidates_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const colour_gains_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const post_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const posts_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const distance_cue_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const refined_post_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const refinement_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const odometry_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const kinematics_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const pose_hypothesis_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const pose_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const particles_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const truth_t&, std::span<const std::uint8_t> encoded);
bool lengths_add_up(const status_t&, std::span<const std::uint8_t> encoded);

}  // namespace goalmouth
