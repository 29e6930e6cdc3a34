#include "core/geometry/segment.h"

#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(DistanceToSegment, IsToTheNearestOfItsPoints) {
    const Vector2d from(1.0, 1.0);
    const Vector2d to(4.0, 1.0);
    EXPECT_DOUBLE_EQ(distance_to_segment<2>(from, to, {2.0, -1.0}), 2.0) << "beside it";
    EXPECT_DOUBLE_EQ(distance_to_segment<2>(from, to, {7.0, 5.0}), 5.0) << "beyond one end";
    EXPECT_DOUBLE_EQ(distance_to_segment<2>(from, to, {0.0, 0.0}), std::sqrt(2.0)) << "beyond the other";
    EXPECT_DOUBLE_EQ(distance_to_segment<2>(from, to, {3.0, 1.0}), 0.0);
    EXPECT_DOUBLE_EQ(distance_to_segment<2>(from, from, {1.0, 3.0}), 2.0) << "a point";
}

TEST(DistanceToSegment, InSpace) {
    EXPECT_DOUBLE_EQ(distance_to_segment<3>({0, 0, 0}, {0, 0, 2}, {3, 4, 1}), 5.0);
    EXPECT_DOUBLE_EQ(distance_to_segment<3>({0, 0, 0}, {0, 0, 2}, {2, 1, 4}), 3.0);
    EXPECT_DOUBLE_EQ(distance_to_segment<3>({1, 2, 2}, {1, 2, 2}, Vector3d::Zero()), 3.0);
}

}  // namespace
}  // namespace goalmouth
