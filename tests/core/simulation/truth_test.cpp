#include "core/simulation/truth.h"

#include "core/simulation/robot.h"
#include "tests/core/simulation/hall_support.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::camera_at;

const TruePost* find(const std::vector<TruePost>& posts, int id) {
    const auto found =
        std::find_if(posts.begin(), posts.end(), [&](const TruePost& p) { return p.id == id; });
    return found == posts.end() ? nullptr : &*found;
}

TEST(TruePosts, AgreeWithAnIndependentProjection) {
    // The post as a cloud of points on its surface, each projected by itself; their hull's sides are the
    // edges.
    const Field field;
    const Scene scene = make_scene(field, {});
    const Intrinsics camera;
    Random random(2);
    int compared = 0;
    for (int i = 0; i < 60; ++i) {
        const Eigen::Isometry3d T_WC =
            camera_at(random.uniform(-2, 2), random.uniform(-1.8, 1.8), random.uniform(-3, 3), 0.42,
                      random.uniform(-0.3, 0.3), random.uniform(-0.2, 0.4));
        for (const TruePost& post : true_posts(scene, camera, T_WC)) {
            if (post.visible < 0.2) continue;
            ++compared;
            const Eigen::Vector2d foot = field.posts()[static_cast<std::size_t>(post.id)];
            EXPECT_NEAR(post.distance_m, (foot - T_WC.translation().head<2>()).norm(), 1e-12);
            const auto signed_distance = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                            const Eigen::Vector2d& p) {
                const Eigen::Vector2d d = (b - a).normalized();
                return d.x() * (p.y() - a.y()) - d.y() * (p.x() - a.x());
            };
            double left = -1e9, right = -1e9;  // how far points reach beyond the edges, px
            for (int k = 0; k < 2000; ++k) {
                const double a = k * std::numbers::pi / 1000.0;
                const double z = random.uniform(0.0, field.goal_height + 0.05);
                const auto p =
                    project(camera, T_WC.inverse() * Eigen::Vector3d(foot.x() + 0.05 * std::cos(a),
                                                                     foot.y() + 0.05 * std::sin(a), z));
                ASSERT_TRUE(p);
                left = std::max(left, signed_distance(post.edges.left_top, post.edges.left_base, *p));
                right = std::max(right, -signed_distance(post.edges.right_top, post.edges.right_base, *p));
            }
            EXPECT_NEAR(left, 0.0, 0.01);
            EXPECT_NEAR(right, 0.0, 0.01);
        }
    }
    EXPECT_GT(compared, 30);
}

TEST(TruePosts, BearingIsPositiveToTheLeft) {
    const Scene scene = make_scene(Field{}, {});
    const auto posts = true_posts(scene, Intrinsics{}, camera_at(0.0, 0.0, 0.0, 0.42, 0.0, 0.1));
    const TruePost* left = find(posts, 2);
    const TruePost* right = find(posts, 3);
    ASSERT_TRUE(left && right);
    EXPECT_NEAR(left->bearing_rad, std::atan(0.75 / 3.0), 0.01);
    EXPECT_NEAR(right->bearing_rad, -left->bearing_rad, 1e-9);
    EXPECT_EQ(find(posts, 0), nullptr);  // behind the camera
    EXPECT_NEAR(left->visible, 1.0, 1e-9);
}

TEST(TruePosts, VisibleShareCountsWhatTheImageCuts) {
    const Scene scene = make_scene(Field{}, {});
    const Intrinsics camera;
    // Level, at 0.42 m, one metre from the post: the image's upper rim is at 0.42 + 1·tan(23.4°) = 0.853 m.
    const auto posts = true_posts(scene, camera, camera_at(2.0, 0.75, 0.0, 0.42, 0.0, 0.0));
    const TruePost* post = find(posts, 2);
    ASSERT_TRUE(post);
    const double top = 0.42 + 240.0 / camera.fy;
    const double bottom = 0.42 - 240.0 / camera.fy;
    EXPECT_NEAR(post->visible, (top - std::max(0.0, bottom)) / 0.95, 0.03);
}

TEST(TruePosts, HiddenPostsAreNotVisible) {
    const Scene scene = make_scene(Field{}, {});
    // Along the goal line, the near post stands before the far one.
    const auto posts =
        true_posts(scene, Intrinsics{}, camera_at(3.0, 1.75, -std::numbers::pi / 2, 0.42, 0.0, 0.0));
    const TruePost* near = find(posts, 2);
    const TruePost* far = find(posts, 3);
    ASSERT_TRUE(near && far);
    EXPECT_GT(near->visible, 0.8);
    EXPECT_LT(far->visible, 0.01);
}

TEST(TruePosts, TheBallHidesAPostsFoot) {
    SceneParameters p;
    p.ball_on_penalty_mark = false;
    p.ball_x = 2.6;
    p.ball_y = 0.75;
    Field field;
    field.ball_diameter = 0.2;
    const Eigen::Isometry3d T_WC = camera_at(1.0, 0.75, 0.0, 0.42, 0.0, 0.05);
    const auto with = true_posts(make_scene(field, p), Intrinsics{}, T_WC);
    p.ball_x = -2.0;
    const auto without = true_posts(make_scene(field, p), Intrinsics{}, T_WC);
    ASSERT_TRUE(find(with, 2) && find(without, 2));
    EXPECT_GT(find(without, 2)->visible, find(with, 2)->visible + 0.03);
}

TEST(TruePosts, InsideCountsWhatTheImageCutsAlone) {
    SceneParameters p;
    p.ball_on_penalty_mark = false;
    p.ball_x = 2.6;
    p.ball_y = 0.75;
    Field field;
    field.ball_diameter = 0.2;
    const auto posts =
        true_posts(make_scene(field, p), Intrinsics{}, camera_at(1.8, 0.75, 0.0, 0.42, 0.0, 0.05));
    const TruePost* post = find(posts, 2);
    ASSERT_TRUE(post);
    // One metre and a fifth away, looking down 0.05 rad: the upper rim cuts the post, the ball hides its
    // foot.
    const double top = 0.42 + 1.2 * std::tan(std::atan(240.0 / Intrinsics{}.fy) - 0.05);
    EXPECT_NEAR(post->inside, top / 0.95, 0.02);
    EXPECT_LT(post->visible, post->inside - 0.03);
}

TEST(TruePosts, AnOwnGoalThatDoesNotStandIsNotThere) {
    SceneParameters p;
    const Eigen::Isometry3d T_WC = camera_at(0.0, 0.0, std::numbers::pi, 0.42, 0.0, 0.0);
    EXPECT_EQ(true_posts(make_scene(Field{}, p), Intrinsics{}, T_WC).size(), 2U);
    p.own_goal = false;
    EXPECT_TRUE(true_posts(make_scene(Field{}, p), Intrinsics{}, T_WC).empty());
    // Nor does it hide anything: from behind it, along the field, its post stood before the other goal's.
    const Eigen::Isometry3d behind = camera_at(-3.9, 0.75, 0.0, 0.42, 0.0, 0.0);
    const auto without = true_posts(make_scene(Field{}, p), Intrinsics{}, behind);
    p.own_goal = true;
    const auto with = true_posts(make_scene(Field{}, p), Intrinsics{}, behind);
    ASSERT_TRUE(find(with, 2) && find(without, 2));
    EXPECT_LT(find(with, 2)->visible, 0.1);
    EXPECT_NEAR(find(without, 2)->visible, 1.0, 0.01);
}

/// Share of a post that a camera sees, by rays to many points of its silhouette against every solid thing.
double cast_share(const Scene& scene, const Intrinsics& camera, const Eigen::Isometry3d& T_WC, int id) {
    const Cylinder& post = scene.posts[static_cast<std::size_t>(id)];
    const auto outline = silhouette(post, T_WC);
    const Eigen::Vector3d eye = T_WC.translation();
    constexpr int across = 60, along = 300;
    int seen = 0;
    for (int i = 0; i < across; ++i)
        for (int k = 0; k < along; ++k) {
            const double s = (i + 0.5) / across;
            const Eigen::Vector3d at =
                post.base + (k + 0.5) / along * post.length * post.axis +
                post.radius * ((1.0 - s) * outline->left_contact + s * outline->right_contact);
            const auto pixel = project(camera, T_WC.inverse() * at);
            bool clear = pixel && pixel->x() >= -0.5 && pixel->y() >= -0.5 &&
                         pixel->x() <= camera.width - 0.5 && pixel->y() <= camera.height - 0.5;
            for (const Tube& tube : scene.tubes) {
                if (!clear) break;
                if (tube.of != Tube::Of::robot) continue;
                const auto t = test::meets_solid(tube.cylinder, eye, at - eye);
                clear = !t || *t > 1.0;
            }
            if (clear) ++seen;
        }
    return seen / static_cast<double>(across * along);
}

TEST(TruePosts, RobotsHideWhatRaysSayTheyHide) {
    Random random(8);
    const Intrinsics camera;
    SceneParameters p;
    p.ball_on_penalty_mark = false;
    p.ball_x = -2.9;
    p.spectators = 0;
    const Scene bare = make_scene(Field{}, p);
    int partly = 0;
    for (int i = 0; i < 60; ++i) {
        Scene scene = bare;
        const double distance = random.uniform(1.2, 4.0);
        for (int k = 0; k < 3; ++k)
            add_robot(scene, {{3.0 - random.uniform(0.2, 0.8) * distance, 0.75 + random.uniform(-0.15, 0.15),
                               random.uniform(-3, 3)},
                              random.uniform() < 0.3,
                              0.45,
                              {}});
        const Eigen::Isometry3d T_WC =
            camera_at(3.0 - distance, 0.75, random.uniform(-0.2, 0.2), 0.42, random.uniform(-0.3, 0.3), 0.1);
        const auto posts = true_posts(scene, camera, T_WC);
        const TruePost* post = find(posts, 2);
        if (!post) continue;  // a camera in the robot
        const double expected = cast_share(scene, camera, T_WC, 2);
        // 48 rows and 7 columns of samples: an edge may fall between two of them all the way along.
        EXPECT_NEAR(post->visible, expected, 0.05) << i;
        if (expected > 0.1 && expected < 0.9) ++partly;
    }
    EXPECT_GT(partly, 20);
}

TEST(TruePosts, ARobotHidesTheLowerPartOfAPost) {
    // Two wide lying cylinders, one on the other, before the post: all below a level edge is hidden.
    SceneParameters p;
    p.ball_on_penalty_mark = false;
    p.ball_x = -2.9;
    Scene scene = make_scene(Field{}, p);
    const Eigen::Isometry3d T_WC = camera_at(1.0, 0.75, 0.0, 0.42, 0.0, 0.0);
    scene.tubes.push_back({cylinder_between({2.0, 0.55, 0.3}, {2.0, 0.95, 0.3}, 0.08), {}, Tube::Of::robot});
    scene.tubes.push_back({cylinder_between({2.0, 0.55, 0.1}, {2.0, 0.95, 0.1}, 0.14), {}, Tube::Of::robot});
    // The plane through the camera that touches the upper one from above meets the post 2 m away.
    const double down = std::atan2(0.12, 1.0) - std::asin(0.08 / std::hypot(1.0, 0.12));
    const double edge = 0.42 - 2.0 * std::tan(down);
    const auto posts = true_posts(scene, Intrinsics{}, T_WC);
    ASSERT_TRUE(find(posts, 2));
    EXPECT_NEAR(edge / 0.95, 0.36, 0.02);
    EXPECT_NEAR(find(posts, 2)->visible, 1.0 - edge / 0.95, 0.015);
    EXPECT_NEAR(find(posts, 2)->inside, 1.0, 1e-9);
}

TEST(TruePosts, PeopleInFrontHide) {
    SceneParameters p;
    p.spectators = 0;
    Scene scene = make_scene(Field{}, p);
    scene.tubes.push_back({cylinder_between({2.0, 0.75, 0.0}, {2.0, 0.75, 1.9}, 0.2), {}, Tube::Of::hall});
    const auto posts = true_posts(scene, Intrinsics{}, camera_at(1.0, 0.75, 0.0, 0.42, 0.0, 0.0));
    ASSERT_TRUE(find(posts, 2));
    EXPECT_EQ(find(posts, 2)->visible, 0.0);
}

TEST(Hit, MeetsTheNearSide) {
    const Ball ball{{0, 3, 0.1}, 0.1, {}};
    const auto t = hit(ball, {0, 0, 0.1}, {0, 2, 0});
    ASSERT_TRUE(t);
    EXPECT_NEAR(*t, 1.45, 1e-12);
    EXPECT_FALSE(hit(ball, {0, 0, 0.1}, {0, -2, 0}));
    EXPECT_FALSE(hit(ball, {0, 0, 0.1}, {0.1, 2, 0}));
}

TEST(TruePosts, WhatTheLensModelFoldsIntoTheImageIsNotInside) {
    // From r = 2.24 on (66° off the axis) the radial part is negative, and points come to lie on the other
    // side of the principal point: both posts of the goal stand there.
    Intrinsics camera;
    camera.distortion = {-0.2, 0.0, 0.0, 0.0, 0.0};
    SceneParameters p;
    p.spectators = 0;
    const Scene scene = make_scene(Field{}, p);
    const double x = scene.posts[2].base.x();
    const double y = scene.posts[2].base.y();
    const Eigen::Isometry3d T_WC = camera_at(x - 0.5, y - 1.15, 0.0, 0.42, 0.0, 0.0);
    const auto pixel = project(camera, T_WC.inverse() * Eigen::Vector3d(x, y, 0.42));
    ASSERT_TRUE(pixel);
    ASSERT_GT(pixel->x(), 0.0) << "the case this test is about";
    ASSERT_LT(pixel->x(), camera.width);
    const auto posts = true_posts(scene, camera, T_WC);
    ASSERT_TRUE(find(posts, 2));
    EXPECT_EQ(find(posts, 2)->inside, 0.0);
    EXPECT_EQ(find(posts, 2)->visible, 0.0);
}

}  // namespace
}  // namespace goalmouth
