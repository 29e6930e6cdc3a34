#include "core/segmentation/scan_lines.h"

#include "tests/support/allocations.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

bool strictly_ascending_within(const std::vector<int>& positions, int size) {
    return std::adjacent_find(positions.begin(), positions.end(), std::greater_equal<>()) ==
               positions.end() &&
           (positions.empty() || (positions.front() >= 0 && positions.back() < size));
}

TEST(ScanLines, AreEquidistantInTheImage) {
    ScanLineParameters parameters;
    parameters.row_spacing = 5;
    parameters.column_spacing = 11;
    const ScanLayout layout = image_layout(640, 480, parameters);
    EXPECT_EQ(layout.rows.size(), 96U);
    for (std::size_t i = 1; i < layout.rows.size(); ++i) EXPECT_EQ(layout.rows[i] - layout.rows[i - 1], 5);
    for (std::size_t i = 1; i < layout.columns.size(); ++i)
        EXPECT_EQ(layout.columns[i] - layout.columns[i - 1], 11);
    EXPECT_LT(layout.columns.front(), 11);
    EXPECT_GE(layout.columns.back(), 640 - 11);
}

TEST(ScanLines, OfATinyImageIsStillOneEach) {
    for (int width = 1; width <= 3; ++width) {
        const ScanLayout layout = image_layout(width, 1, {});
        EXPECT_EQ(layout.rows, std::vector<int>{0});
        EXPECT_EQ(layout.columns.size(), 1U);
        EXPECT_LT(layout.columns.front(), width);
    }
    EXPECT_TRUE(image_layout(0, 0, {}).rows.empty());
}

TEST(ScanLines, AreEquidistantOnTheFieldWhereTheImageCanShowIt) {
    ScanLineParameters parameters;
    parameters.row_spacing = 1;
    parameters.largest_spacing = 480;
    parameters.field_spacing = 0.2;
    const Intrinsics camera;
    const Eigen::Isometry3d T_BC = camera_in_body(0.4, 0.0, 0.35);
    const ScanLayout layout = field_layout(camera, T_BC, parameters);
    ASSERT_TRUE(strictly_ascending_within(layout.rows, camera.height));
    int compared = 0;
    for (std::size_t i = 1; i < layout.rows.size(); ++i) {
        const auto far = ground_point(camera, T_BC, {319.5, static_cast<double>(layout.rows[i - 1])});
        const auto near = ground_point(camera, T_BC, {319.5, static_cast<double>(layout.rows[i])});
        const auto beyond =
            ground_point(camera, T_BC, {319.5, static_cast<double>(layout.rows[i - 1]) + 1.0});
        if (!far || !near || !beyond || far->norm() > 2.0) continue;
        const double one_row = (*far - *beyond).norm();
        EXPECT_GE((*far - *near).norm(), 0.2 - 1e-9);
        EXPECT_LE((*far - *near).norm(), 0.2 + one_row);
        ++compared;
    }
    EXPECT_GE(compared, 5);
}

TEST(ScanLines, OnTheFieldKeepTheirBoundsInTheImage) {
    ScanLineParameters parameters;
    parameters.row_spacing = 3;
    parameters.largest_spacing = 20;
    parameters.field_spacing = 0.1;
    const Intrinsics camera;
    for (const double pitch : {-0.6, 0.0, 0.3, 0.8}) {
        const ScanLayout layout = field_layout(camera, camera_in_body(0.4, 0.1, pitch), parameters);
        ASSERT_TRUE(strictly_ascending_within(layout.rows, camera.height));
        for (std::size_t i = 1; i < layout.rows.size(); ++i) {
            EXPECT_GE(layout.rows[i] - layout.rows[i - 1], 3);
            EXPECT_LE(layout.rows[i] - layout.rows[i - 1], 20);
        }
        EXPECT_LT(layout.rows.front(), 20);
    }
}

TEST(ScanLines, OnTheFieldFallBackToTheImageWithoutPoseOrGround) {
    ScanLineParameters parameters;
    parameters.spacing = "field";
    const Intrinsics camera;
    const ScanLayout image = image_layout(camera.width, camera.height, parameters);
    EXPECT_EQ(scan_layout(camera, std::nullopt, parameters).rows, image.rows);
    const auto up = camera_in_body(0.4, 0.0, -1.2);
    EXPECT_EQ(scan_layout(camera, up, parameters).rows, image.rows);
    EXPECT_EQ(scan_layout(camera, up, parameters).columns, image.columns);
    EXPECT_NE(scan_layout(camera, camera_in_body(0.4, 0.0, 0.3), parameters).rows, image.rows);
}

void expect_same_layout(const ScanLayout& a, const ScanLayout& b) {
    EXPECT_EQ(a.rows, b.rows);
    EXPECT_EQ(a.columns, b.columns);
}

TEST(LatestScanLayout, FollowsCameraAndPose) {
    for (const std::string spacing : {"image", "field"}) {
        ScanLineParameters parameters;
        parameters.spacing = spacing;
        LatestScanLayout latest(parameters);
        for (const int width : {640, 320, 320, 640}) {
            const Intrinsics camera = scaled_to(Intrinsics{}, width, width * 3 / 4);
            for (const double pitch : {0.3, 0.3, 0.5}) {
                const auto T_BC = camera_in_body(0.4, 0.0, pitch);
                expect_same_layout(latest.at(camera, T_BC), scan_layout(camera, T_BC, parameters));
            }
            expect_same_layout(latest.at(camera, std::nullopt),
                               scan_layout(camera, std::nullopt, parameters));
        }
    }
}

TEST(LatestScanLayout, AllocatesNothingWhereNothingChanged) {
    if (!test::allocations_are_counted()) GTEST_SKIP() << "skipped: allocations are not counted here";
    LatestScanLayout latest(ScanLineParameters{});
    latest.at(Intrinsics{}, std::nullopt);
    const auto moved = camera_in_body(0.4, 0.0, 0.5);
    const test::AllocationCount count;
    latest.at(Intrinsics{}, moved);
    EXPECT_EQ(count.so_far(), 0U);
}

}  // namespace
}  // namespace goalmouth
