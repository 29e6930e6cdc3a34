#include "core/simulation/truth.h"

#include "tests/core/simulation/measured.h"

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

TEST(Hit, MeetsTheNearSide) {
    const Cylinder post{{2.0, 0.0, 0.0}, Eigen::Vector3d::UnitZ(), 1.0, 0.1};
    const auto t = hit(post, {0, 0, 0.5}, {2, 0, 0});
    ASSERT_TRUE(t);
    EXPECT_NEAR(*t, 0.95, 1e-12);
    EXPECT_FALSE(hit(post, {0, 0, 0.5}, {-2, 0, 0}));
    EXPECT_FALSE(hit(post, {0, 0, 1.5}, {2, 0, 0}));
    EXPECT_FALSE(hit(post, {0, 0, 0.5}, {2, 0.2, 0}));
    const Ball ball{{0, 3, 0.1}, 0.1, {}};
    const auto b = hit(ball, {0, 0, 0.1}, {0, 1, 0});
    ASSERT_TRUE(b);
    EXPECT_NEAR(*b, 2.9, 1e-12);
}

}  // namespace
}  // namespace goalmouth
