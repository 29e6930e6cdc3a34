#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// What a post's measurements lack; bits as in post_t.
namespace post_flag {
inline constexpr std::uint32_t left_edge_missing = 1;
inline constexpr std::uint32_t right_edge_missing = 2;
inline constexpr std::uint32_t cut_top = 4;
inline constexpr std::uint32_t cut_bottom = 8;
inline constexpr std::uint32_t cut_left = 16;
inline constexpr std::uint32_t cut_right = 32;
inline constexpr std::uint32_t fills_image = 64;
inline constexpr std::uint32_t no_distance = 128;
inline constexpr std::uint32_t refined = 256;
}  // namespace post_flag

enum class PostSide : std::int8_t { unknown = 0, left = 1, right = 2 };

/// A goalpost in the image [px], and what follows from its width.
struct Post {
    Eigen::Vector2d left_top = Eigen::Vector2d::Zero();
    Eigen::Vector2d left_base = Eigen::Vector2d::Zero();
    Eigen::Vector2d right_top = Eigen::Vector2d::Zero();
    Eigen::Vector2d right_base = Eigen::Vector2d::Zero();
    std::uint32_t flags = 0;  // post_flag bits
    PostSide side = PostSide::unknown;
    double width_px = 0.0;
    double distance_m = 0.0;                               // camera to post by its width; 0 with no_distance
    double bearing_rad = 0.0;                              // in frame C, + left
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of (distance [m], bearing [rad])
    int support_left = 0;
    int support_right = 0;

    bool has(std::uint32_t flag) const { return (flags & flag) != 0; }
};

}  // namespace goalmouth
