#include "core/geometry/cylinder.h"
#include "tools/evaluate/images_measures.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// A robot on a field whose goalposts it sees as upright cylinders.
struct View {
    Field field;
    Intrinsics camera = from_horizontal_fov(1280, 960, 61.0 * degree);
    RobotPlace place;
    double turned = 0.0;  // rad: how much farther left the robot really looks than it says
    double pitch = 0.0;

    ReferencePost outline(std::size_t goalpost) const {
        const Eigen::Vector2d foot = field.posts()[goalpost];
        const Cylinder post{
            {foot.x(), foot.y(), 0.0}, Eigen::Vector3d::UnitZ(), 0.8, 0.5 * field.post_diameter};
        const Pose2 feet{place.feet.x, place.feet.y, place.feet.theta + turned};
        const Eigen::Isometry3d T_WC = on_ground(feet) * camera_in_body(0.45, 0.0, pitch, place.head_yaw);
        const auto edges = project_edges(camera, T_WC, post);
        EXPECT_TRUE(edges);
        return {edges->left_top, edges->left_base, edges->right_top, edges->right_base};
    }
    std::vector<std::optional<PlacedPost>> placed(const std::vector<ReferencePost>& outlines) const {
        return place_posts(outlines, camera, place, field);
    }
};

TEST(PlacedPosts, AreThoseTheRobotLooksAt) {
    View view;
    view.place = {{0.2, 0.6, 170.0 * degree}, 12.0 * degree, 0.0};
    // From there own left (0) is to the right of own right (1).
    const auto placed = view.placed({view.outline(0), view.outline(1)});
    ASSERT_TRUE(placed[0] && placed[1]);
    EXPECT_EQ(placed[0]->goalpost, 0U);
    EXPECT_EQ(placed[1]->goalpost, 1U);
    EXPECT_NEAR(placed[0]->distance, std::hypot(3.2, 0.15), 1e-12);
    EXPECT_NEAR(placed[1]->distance, std::hypot(3.2, 1.35), 1e-12);
    EXPECT_NEAR(placed[0]->direction_error, 0.0, 0.1 * degree);
}

TEST(PlacedPosts, BearAPlacementThatIsDegreesOff) {
    View view;
    for (const double off : {-9.0, 9.0}) {
        view.turned = off * degree;
        const auto placed = view.placed({view.outline(3), view.outline(2)});
        ASSERT_TRUE(placed[0] && placed[1]);
        EXPECT_EQ(placed[0]->goalpost, 3U);
        EXPECT_EQ(placed[1]->goalpost, 2U);
        EXPECT_NEAR(placed[0]->direction_error, -off * degree, 0.2 * degree);
    }
}

TEST(PlacedPosts, KeepTheirOrderWhereTheyStandClose) {
    View view;
    view.place.feet = {-3.5, 0.3, 0.0};  // the far goal's posts are 13° apart
    view.turned = 8.0 * degree;          // more than half of that
    const auto placed = view.placed({view.outline(2), view.outline(3)});
    ASSERT_TRUE(placed[0] && placed[1]);
    EXPECT_EQ(placed[0]->goalpost, 2U);
    EXPECT_EQ(placed[1]->goalpost, 3U);
}

TEST(PlacedPosts, ElsewhereAreNone) {
    View view;
    const ReferencePost seen = view.outline(2);
    view.place.feet.theta += 20.0 * degree;  // beyond three times the placement's σ
    EXPECT_FALSE(view.placed({seen})[0]);
    view.place.feet.theta = std::numbers::pi / 2.0;  // no goal in view
    EXPECT_FALSE(view.placed({seen})[0]);
    EXPECT_TRUE(view.placed({}).empty());
}

TEST(PlacedPosts, AreOneGoalpostEach) {
    View view;
    const auto placed = view.placed({view.outline(2), view.outline(2)});
    EXPECT_NE(placed[0].has_value(), placed[1].has_value());
}

TEST(OutlineDistance, IsTheTrueOneWhereverThePostIsAndHoweverTheCameraLooks) {
    View view;
    for (const double pitch : {0.0, 20.0}) {
        view.pitch = pitch * degree;
        for (const double heading : {-10.0, 0.0, 10.0}) {
            view.place.feet = {0.0, 0.0, heading * degree};
            for (const std::size_t post : {2, 3}) {
                const auto distance =
                    outline_distance(view.outline(post), view.camera, view.field.post_diameter);
                ASSERT_TRUE(distance);
                EXPECT_NEAR(*distance, std::hypot(3.0, 0.75), 0.01);
            }
        }
    }
}

TEST(OutlineDistance, NeedsBothEdgesInThePicture) {
    View view;
    ReferencePost outline = view.outline(2);
    outline.left_top.x() = -3.0;
    EXPECT_FALSE(outline_distance(outline, view.camera, 0.1));
    EXPECT_FALSE(outline_distance({{5, 0}, {5, 100}, {5, 0}, {5, 100}}, view.camera, 0.1));
}

TEST(EdgeErrors, AreTakenAlongTheRowAtThreeHeights) {
    const ReferencePost truth{{100, 0}, {100, 200}, {120, 0}, {120, 200}};
    Post post;  // its left edge turned about (100, 50), its right one moved, both of another length
    post.left_top = {99, 0};
    post.left_base = {101, 100};
    post.right_top = {121.5, 20};
    post.right_base = {121.5, 180};
    const EdgeErrors errors = edge_errors(truth, post, 640);
    const std::array<double, 3> left{0.0, 1.0, 2.0};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(errors.left[i].value(), left[i], 1e-12);
        EXPECT_NEAR(errors.right[i].value(), 1.5, 1e-12);
        EXPECT_NEAR(errors.width[i].value(), 1.5 - left[i], 1e-12);
    }
}

TEST(EdgeErrors, LeaveOutWhatIsNotThere) {
    const ReferencePost truth{{600, 0}, {600, 200}, {620, 0}, {660, 200}};  // leaves the picture halfway
    Post post;
    post.left_top = {600, 0};
    post.left_base = {600, 200};
    post.right_top = {621, 0};
    post.right_base = {661, 200};
    EdgeErrors errors = edge_errors(truth, post, 640);
    EXPECT_TRUE(errors.right[0]);
    EXPECT_FALSE(errors.right[2]);
    EXPECT_FALSE(errors.width[2]);
    EXPECT_TRUE(errors.left[2]);
    post.flags = post_flag::left_edge_missing;
    errors = edge_errors(truth, post, 640);
    EXPECT_FALSE(errors.left[0]);
    EXPECT_FALSE(errors.width[0]);
    EXPECT_TRUE(errors.right[0]);
}

TEST(DistanceSummary, IsOfThoseThatHaveAnEstimate) {
    const std::vector<DistanceSample> samples{{2.0, 2.2}, {2.4, 2.28}, {4.1, {}}, {4.2, 4.2}};
    const auto all = distance_summary(samples);
    ASSERT_TRUE(all);
    EXPECT_EQ(all->posts, 3U);
    EXPECT_EQ(all->without, 1U);
    EXPECT_NEAR(all->errors.bias, 0.08 / 3.0, 1e-12);
    EXPECT_NEAR(all->relative_rms, std::sqrt((0.01 + 0.0025) / 3.0), 1e-12);
    EXPECT_NEAR(all->median_relative, 0.05, 1e-12);
    const auto steps = by_distance(samples);
    ASSERT_EQ(steps.size(), 2U);
    EXPECT_EQ(steps[0].from, 2.0);
    EXPECT_EQ(steps[0].to, 2.5);
    EXPECT_EQ(steps[0].posts, 2U);
    EXPECT_EQ(steps[1].posts, 1U);
    EXPECT_EQ(steps[1].without, 1U);
    EXPECT_FALSE(distance_summary({{1.0, {}}}));
}

}  // namespace
}  // namespace goalmouth
