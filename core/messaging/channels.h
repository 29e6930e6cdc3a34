#pragma once

// Default names of the channels; a graph file may rename them for each process.
namespace goalmouth::channels {

inline constexpr const char* image = "IMAGE";          // image_t, descriptor
inline constexpr const char* image_tap = "IMAGE_TAP";  // image_t, self-contained, where it fits a datagram
inline constexpr const char* image_slices =
    "IMAGE_SLICES";  // image_slice_t, a self-contained image_t in pieces
inline constexpr const char* camera_info = "CAMERA_INFO";      // camera_info_t
inline constexpr const char* segments = "SEGMENTS";            // segments_t
inline constexpr const char* border = "BORDER";                // border_t
inline constexpr const char* candidates = "CANDIDATES";        // candidates_t
inline constexpr const char* colour_gains = "COLOUR_GAINS";    // colour_gains_t: how light has changed
inline constexpr const char* posts = "POSTS";                  // posts_t
inline constexpr const char* posts_refined = "POSTS_REFINED";  // posts_t, measured to a fraction of a pixel
inline constexpr const char* refinement = "REFINEMENT";        // refinement_t: how they were measured
inline constexpr const char* odometry = "ODOMETRY";            // odometry_t
inline constexpr const char* kinematics = "KINEMATICS";        // kinematics_t
inline constexpr const char* pose = "POSE";                    // pose_t
inline constexpr const char* particles = "PARTICLES";          // particles_t
inline constexpr const char* truth = "TRUTH";                  // truth_t
inline constexpr const char* status = "STATUS";                // status_t

}  // namespace goalmouth::channels
