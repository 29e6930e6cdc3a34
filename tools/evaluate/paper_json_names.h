#pragma once

#include <array>

namespace goalmouth {

// The names that writing and reading a result share.

/// Value of "what" in the file.
inline constexpr const char* paper_what = "paper";

/// One row of "frames": places in "scenes" and "detectors", cell and index of the frame; numbers of posts;
/// for the post in line and the other one the sum of post_state bits, error of the distance [m], offsets of
/// left and right edge [px], error of the bearing [rad]; of the post in line the bound of its distance [m]
/// and the normalised squared error.
inline constexpr std::array<const char*, 17> frame_columns = {"scene",
                                                              "cell",
                                                              "index",
                                                              "detector",
                                                              "posts",
                                                              "detected",
                                                              "identified",
                                                              "false_posts",
                                                              "in_line",
                                                              "in_line_error_m",
                                                              "left_edge_px",
                                                              "right_edge_px",
                                                              "bearing_error",
                                                              "second",
                                                              "second_error_m",
                                                              "in_line_bound_m",
                                                              "in_line_normalised_error"};

namespace post_state {
inline constexpr int counts = 1;
inline constexpr int detected = 2;
inline constexpr int identified = 4;
inline constexpr int good = 8;         // in_line alone
inline constexpr int both_edges = 16;  // likewise
}  // namespace post_state

}  // namespace goalmouth
