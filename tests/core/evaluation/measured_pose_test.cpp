#include "core/evaluation/measured_pose.h"

#include "core/evaluation/cell_renderer.h"
#include "core/geometry/camera.h"

#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

Eigen::Isometry3d camera_on_the_field() {
    Eigen::Isometry3d T_WC = camera_in_body(0.42, 0.3, 0.05, -0.1);
    T_WC.pretranslate(Eigen::Vector3d(1.5, -0.75, 0.0));
    return T_WC;
}

TEST(MeasuredPose, StandsUprightUnderTheCamera) {
    const Eigen::Isometry3d T_WC = camera_on_the_field();
    const auto pose = measured_pose(T_WC, {.attitude_sigma = 0.0, .height_sigma = 0.0}, Random(3));
    ASSERT_TRUE(pose);
    EXPECT_TRUE(pose->T_BC.linear().isApprox(T_WC.linear(), 1e-12));
    EXPECT_TRUE(pose->T_BC.translation().isApprox(Eigen::Vector3d(0.0, 0.0, 0.42), 1e-12));
    EXPECT_TRUE(pose->covariance.isZero());
}

TEST(MeasuredPose, ErrsAsMuchAsItSays) {
    const Eigen::Isometry3d T_WC = camera_on_the_field();
    const MeasuredPoseParameters parameters{.attitude_sigma = 0.02, .height_sigma = 0.03};
    Eigen::Vector3d turns = Eigen::Vector3d::Zero();
    double lift = 0.0;
    constexpr int draws = 2000;
    for (std::uint64_t i = 0; i < draws; ++i) {
        const CameraPose pose = measured_pose(T_WC, parameters, Random(i)).value();
        const Eigen::AngleAxisd error(pose.T_BC.linear() * T_WC.linear().transpose());
        turns += (error.angle() * error.axis()).array().square().matrix();
        lift += std::pow(pose.T_BC.translation().z() - 0.42, 2);
        EXPECT_TRUE(pose.T_BC.translation().head<2>().isZero());
    }
    for (const double squares : turns) EXPECT_NEAR(std::sqrt(squares / draws), 0.02, 0.0015);
    EXPECT_NEAR(std::sqrt(lift / draws), 0.03, 0.002);
    const CameraPose pose = measured_pose(T_WC, parameters, Random(1)).value();
    EXPECT_DOUBLE_EQ(pose.covariance(2, 2), 0.0009);
    for (int i = 3; i < 6; ++i) EXPECT_DOUBLE_EQ(pose.covariance(i, i), 0.0004);
    EXPECT_TRUE(pose.covariance.isDiagonal());
    EXPECT_FALSE(measured_pose(T_WC, {.told = false}, Random(1)));
}

TEST(MeasuredPose, ChangesNothingElseOfAFrame) {
    EvaluationScene scene;
    scene.name = "plain";
    const Intrinsics camera = scaled_to(Intrinsics{}, 160, 120);
    CellRenderer told(scene, {}, camera, 5);
    scene.parameters.kinematics.told = false;
    CellRenderer untold(scene, {}, camera, 5);
    scene.parameters.kinematics = {.attitude_sigma = 0.3};
    CellRenderer worse(scene, {}, camera, 5);
    const CellFrame a = told.render(7, 2);
    const CellFrame b = untold.render(7, 2);
    const CellFrame c = worse.render(7, 2);
    EXPECT_EQ(a.image.data, b.image.data);
    EXPECT_EQ(a.image.data, c.image.data);
    ASSERT_TRUE(a.kinematics);
    EXPECT_FALSE(b.kinematics);
    EXPECT_FALSE(c.kinematics->T_BC.isApprox(a.kinematics->T_BC, 1e-3));
    EXPECT_TRUE(told.render(7, 2).kinematics->T_BC.isApprox(a.kinematics->T_BC, 0.0));
    EXPECT_FALSE(told.render(7, 3).kinematics->T_BC.isApprox(a.kinematics->T_BC, 1e-6));
}

}  // namespace
}  // namespace goalmouth
