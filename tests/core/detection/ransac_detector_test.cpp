#include "core/detection/ransac_detector.h"

#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

/// Rows of a post that leans by `lean` px a row (+ = the foot lies further right), cut by the image's
/// borders.
void add_post(Candidates& c, double left, double right, double lean, int top, int bottom) {
    for (int y = top; y <= bottom; y += 4) {
        const double l = left + lean * (y - top);
        const double r = right + lean * (y - top);
        const int first = static_cast<int>(std::ceil(std::max(l, -0.5)));
        const int last = static_cast<int>(std::floor(std::min(r, c.width - 0.5)));
        if (last < first) continue;
        c.segments.push_back({Orientation::horizontal, y, first, last});
        if (l > -0.5) c.left_edges.emplace_back(l, y);
        if (r < c.width - 0.5) c.right_edges.emplace_back(r, y);
    }
}

Candidates frame() {
    Candidates c;
    c.width = 640;
    c.height = 480;
    return c;
}

std::vector<Post> detect(const Candidates& c, std::uint64_t seed = 1) {
    Random random(seed);
    return detect_posts_by_ransac(c, {}, 0.1, {}, random);
}

TEST(RansacDetector, FindsALeaningPostToItsCorners) {
    Candidates c = frame();
    add_post(c, 300.3, 320.8, 0.25, 20, 220);
    const auto posts = detect(c);
    ASSERT_EQ(posts.size(), 1U);
    const Post& post = posts[0];
    // The end points are feet of the extreme points on the line, so they lie on the sides.
    EXPECT_NEAR(post.left_top.x(), 300.3 + 0.25 * (post.left_top.y() - 20), 1e-6);
    EXPECT_NEAR(post.right_base.x(), 320.8 + 0.25 * (post.right_base.y() - 20), 1e-6);
    EXPECT_NEAR(post.left_base.y(), 220, 1e-6);
    EXPECT_NEAR(post.width_px, 20.5 / std::hypot(1.0, 0.25), 1e-6);
    EXPECT_EQ(post.support_left, 51);
    EXPECT_EQ(post.flags, 0U);
    EXPECT_EQ(post.side, PostSide::unknown);
}

TEST(RansacDetector, TellsLeftFromRightOfAPair) {
    Candidates c = frame();
    add_post(c, 420, 440, 0.0, 100, 280);
    add_post(c, 150, 170, 0.0, 100, 280);
    const auto posts = detect(c);
    ASSERT_EQ(posts.size(), 2U);
    EXPECT_LT(posts[0].left_base.x(), posts[1].left_base.x());
    EXPECT_EQ(posts[0].side, PostSide::left);
    EXPECT_EQ(posts[1].side, PostSide::right);
}

TEST(RansacDetector, TellsTheSideOfOnePostByItsCrossbar) {
    for (const bool to_right : {true, false}) {
        Candidates c = frame();
        add_post(c, 300, 320, 0.0, 100, 300);
        for (auto& s : c.segments) {
            if (s.line < 120) (to_right ? s.end : s.start) = to_right ? 500 : 100;
        }
        const auto posts = detect(c);
        ASSERT_EQ(posts.size(), 1U);
        EXPECT_EQ(posts[0].side, to_right ? PostSide::left : PostSide::right);
    }
}

TEST(RansacDetector, ReportsAPostWithOneEdge) {
    Candidates c = frame();
    add_post(c, 615, 660, 0.0, 50, 300);
    auto posts = detect(c);
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_TRUE(posts[0].has(post_flag::right_edge_missing));
    EXPECT_TRUE(posts[0].has(post_flag::cut_right));
    EXPECT_TRUE(posts[0].has(post_flag::no_distance));
    EXPECT_FALSE(posts[0].has(post_flag::left_edge_missing));
    EXPECT_NEAR(posts[0].left_top.x(), 615, 1e-6);
    EXPECT_EQ(posts[0].support_right, 0);
    EXPECT_GT(posts[0].width_px, 0.0);

    c = frame();
    add_post(c, -30, 25, 0.0, 50, 300);
    posts = detect(c);
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_TRUE(posts[0].has(post_flag::left_edge_missing));
    EXPECT_NEAR(posts[0].right_base.x(), 25, 1e-6);

    RansacDetectorParameters parameters;
    parameters.cut_posts.report = false;
    Random random(1);
    EXPECT_TRUE(detect_posts_by_ransac(c, {}, 0.1, parameters, random).empty());
}

TEST(RansacDetector, ReportsAPostThatFillsTheImage) {
    Candidates c = frame();
    add_post(c, -50, 700, 0.0, 2, 478);
    const auto posts = detect(c);
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_TRUE(posts[0].has(post_flag::fills_image));
    EXPECT_TRUE(posts[0].has(post_flag::no_distance));
}

TEST(RansacDetector, DoesNotTakeALoneCrossbarForAPost) {
    Candidates c = frame();
    add_post(c, 100, 500, 0.0, 100, 128);
    EXPECT_TRUE(detect(c).empty());
    c = frame();
    add_post(c, 100, 700, 0.0, 100, 128);
    EXPECT_TRUE(detect(c).empty());
}

TEST(RansacDetector, OfNothingOrOneSideIsNothing) {
    EXPECT_TRUE(detect(frame()).empty());
    EXPECT_TRUE(detect({}).empty());
    Candidates c = frame();
    add_post(c, 300, 320, 0.0, 20, 220);
    c.right_edges.clear();
    EXPECT_TRUE(detect(c).empty());
}

TEST(RansacDetector, IsDeterminedByItsSeed) {
    Candidates c = frame();
    Random random(3);
    add_post(c, 300, 320, 0.1, 20, 220);
    for (int i = 0; i < 60; ++i) {
        c.left_edges.emplace_back(random.uniform(0, 640), random.uniform(0, 480));
        c.right_edges.emplace_back(random.uniform(0, 640), random.uniform(0, 480));
    }
    const auto a = detect(c, 5);
    const auto b = detect(c, 5);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].left_top, b[i].left_top);
        EXPECT_EQ(a[i].covariance, b[i].covariance);
    }
}

TEST(RansacDetector, AnswersFinitelyToNoise) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        Random random(seed);
        Candidates c = frame();
        for (int i = 0; i < 200; ++i) {
            c.left_edges.emplace_back(random.uniform(0, 640), random.index(120) * 4.0);
            c.right_edges.emplace_back(random.uniform(0, 640), random.index(120) * 4.0);
            const int start = static_cast<int>(random.index(600));
            c.segments.push_back({Orientation::horizontal, static_cast<int>(random.index(480)), start,
                                  start + static_cast<int>(random.index(40))});
        }
        for (const Post& post : detect(c, seed)) {
            EXPECT_TRUE(post.covariance.allFinite());
            EXPECT_GT(post.width_px, 0.0);
            EXPECT_TRUE(std::isfinite(post.bearing_rad));
        }
    }
}

}  // namespace
}  // namespace goalmouth
