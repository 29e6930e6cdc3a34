#pragma once

#include <optional>
#include <string>

#include <goalmouth/border_t.hpp>
#include <goalmouth/camera_info_t.hpp>
#include <goalmouth/candidates_t.hpp>
#include <goalmouth/colour_gains_t.hpp>
#include <goalmouth/image_slice_t.hpp>
#include <goalmouth/image_t.hpp>
#include <goalmouth/intrinsics_t.hpp>
#include <goalmouth/kinematics_t.hpp>
#include <goalmouth/odometry_t.hpp>
#include <goalmouth/particles_t.hpp>
#include <goalmouth/pose_t.hpp>
#include <goalmouth/posts_t.hpp>
#include <goalmouth/refinement_t.hpp>
#include <goalmouth/segments_t.hpp>
#include <goalmouth/status_t.hpp>
#include <goalmouth/truth_t.hpp>

namespace goalmouth {

/// What is wrong with a decoded message, in a few words without numbers of the message in it (causes are
/// counted by their text); nothing where it may be used. Checked: sizes agree with arrays, every number
/// finite, every quantity in the range its .lcm file states.
std::optional<std::string> problem(const intrinsics_t& m);
std::optional<std::string> problem(const camera_info_t& m);
std::optional<std::string> problem(const image_t& m);
std::optional<std::string> problem(const image_slice_t& m);
std::optional<std::string> problem(const segments_t& m);
std::optional<std::string> problem(const border_t& m);
std::optional<std::string> problem(const candidates_t& m);
std::optional<std::string> problem(const colour_gains_t& m);
std::optional<std::string> problem(const post_t& m);
std::optional<std::string> problem(const posts_t& m);
std::optional<std::string> problem(const distance_cue_t& m);
std::optional<std::string> problem(const refined_post_t& m);
std::optional<std::string> problem(const refinement_t& m);
std::optional<std::string> problem(const odometry_t& m);
std::optional<std::string> problem(const kinematics_t& m);
std::optional<std::string> problem(const pose_hypothesis_t& m);
std::optional<std::string> problem(const pose_t& m);
std::optional<std::string> problem(const particles_t& m);
std::optional<std::string> problem(const truth_t& m);
std::optional<std::string> problem(const status_t& m);

}  // namespace goalmouth
