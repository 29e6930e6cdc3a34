#include "core/detection/upright_detector.h"

#include "core/geometry/cylinder.h"
#include "core/random/random.h"
#include "tests/support/allocations.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr int spacing = 4;  // px, of scan-lines

/// A camera on a robot that stands in the origin of the ground and looks along x.
struct Robot {
    double height = 0.42;
    double roll = 0.0, pitch = 0.05;  // rad
    Intrinsics camera;

    Eigen::Isometry3d T_BC() const { return camera_in_body(height, roll, pitch); }
    CameraPose told(double roll_error = 0.0, double pitch_error = 0.0) const {
        CameraPose pose;
        pose.T_BC = camera_in_body(height, roll + roll_error, pitch + pitch_error);
        pose.covariance.diagonal() << 0.0, 0.0, 1e-4, 3e-4, 3e-4, 3e-4;
        return pose;
    }
};

/// A thing of the post's colour: upright, round.
Cylinder post_at(double ahead, double left, double top = 0.95, double radius = 0.05) {
    return {{ahead, left, 0.0}, Eigen::Vector3d::UnitZ(), top, radius};
}

/// What a row of one thing shows; tests change it.
struct Row {
    double left, right;
    bool shows = true, left_edge = true, right_edge = true;
};
using Change = std::function<void(Row& row, double from_top)>;  // 0 at the top … 1 at the base

Candidates empty_frame(const Intrinsics& camera) {
    Candidates c;
    c.width = camera.width;
    c.height = camera.height;
    return c;
}

/// Adds what scan-lines see of it, by the geometry of its silhouette's straight edges.
void add(Candidates& c, const Robot& robot, const Cylinder& thing, const Change& change = {}) {
    const auto edges = project_edges(robot.camera, robot.T_BC(), thing);
    ASSERT_TRUE(edges);
    const auto x_at = [](const Eigen::Vector2d& top, const Eigen::Vector2d& base, double y) {
        return top.x() + (y - top.y()) / (base.y() - top.y()) * (base.x() - top.x());
    };
    const double top = std::max(edges->left_top.y(), edges->right_top.y());
    const double base = std::min(edges->left_base.y(), edges->right_base.y());
    for (int y = 2; y < c.height; y += spacing) {
        if (y < top || y > base) continue;
        Row row{x_at(edges->left_top, edges->left_base, y), x_at(edges->right_top, edges->right_base, y)};
        if (change) change(row, (y - top) / (base - top));
        const int first = static_cast<int>(std::ceil(std::max(row.left, -0.5)));
        const int last = static_cast<int>(std::floor(std::min(row.right, c.width - 0.5)));
        if (!row.shows || last < first) continue;
        c.segments.push_back({Orientation::horizontal, y, first, last});
        if (row.left_edge && row.left > -0.5) c.left_edges.emplace_back(row.left, y);
        if (row.right_edge && row.right < c.width - 0.5) c.right_edges.emplace_back(row.right, y);
    }
}

std::vector<Post> detect(const Candidates& c, const Robot& robot, const std::optional<CameraPose>& pose) {
    return UprightDetector({}, Field{}).detect(c, robot.camera, pose);
}

/// Camera to axis along the ground.
double distance_of(const Robot& robot, const Cylinder& post) {
    return (post.base - robot.T_BC().translation()).head<2>().norm();
}

/// Bearing in frame C of the post's axis in the row half-way down what was found of it.
double bearing_in(const Robot& robot, const Cylinder& post, const Post& found) {
    const double row = 0.25 * (found.left_top + found.left_base + found.right_top + found.right_base).y();
    double nearest = 1e9, bearing = 0.0;
    for (double z = 0.0; z < 0.95; z += 0.001) {
        const Eigen::Vector3d at = robot.T_BC().inverse() * (post.base + z * post.axis);
        const auto pixel = project(robot.camera, at);
        if (!pixel || std::abs(pixel->y() - row) > nearest) continue;
        nearest = std::abs(pixel->y() - row);
        bearing = -std::atan(at.x() / at.z());
    }
    return bearing;
}

TEST(UprightDetector, MeasuresPostsAtAnyDistanceAndTilt) {
    for (const double distance : {0.6, 1.5, 3.0, 6.0}) {
        for (const double roll : {0.0, 10.0, -20.0}) {
            for (const double left : {0.0, 0.2}) {
                Robot robot;
                robot.roll = roll * degree;
                const Cylinder post = post_at(distance, left * distance);
                Candidates c = empty_frame(robot.camera);
                add(c, robot, post);
                const auto posts = detect(c, robot, robot.told(0.01, -0.015));
                ASSERT_EQ(posts.size(), 1U) << distance << " m, " << roll;
                EXPECT_NEAR(posts[0].distance_m, distance_of(robot, post), 0.01 * distance);
                EXPECT_NEAR(posts[0].bearing_rad, bearing_in(robot, post, posts[0]), 0.01);
            }
        }
    }
}

TEST(UprightDetector, TakesAnEdgeThatIsSeenInAThirdOfItsRows) {
    // Something of the same colour stands beside the rest: there the colour goes on, and ends far away.
    Robot robot;
    const Cylinder post = post_at(3.0, 0.0);
    for (const bool upper : {true, false}) {
        Candidates c = empty_frame(robot.camera);
        add(c, robot, post, [&](Row& row, double from_top) {
            if (upper ? from_top < 0.65 : from_top > 0.35) row.left -= 70.0;
        });
        const auto posts = detect(c, robot, robot.told());
        ASSERT_EQ(posts.size(), 1U) << upper;
        EXPECT_NEAR(posts[0].distance_m, 3.0, 0.05);
    }
}

TEST(UprightDetector, FindsAPostOfWhichTheLowerHalfIsHidden) {
    Robot robot;
    for (const double distance : {1.5, 3.0, 6.0}) {
        Candidates c = empty_frame(robot.camera);
        add(c, robot, post_at(distance, 0.0), [](Row& row, double from_top) { row.shows = from_top < 0.55; });
        const auto posts = detect(c, robot, robot.told());
        ASSERT_EQ(posts.size(), 1U) << distance;
        EXPECT_NEAR(posts[0].distance_m, distance, 0.03 * distance);
    }
}

TEST(UprightDetector, TheFieldThatShowsBetweenItsEdgesTellsThatThereIsNoPost) {
    // A post three metres away before something of its colour, which is as a nearer post's upper part would
    // be. That one's feet might be hidden, but where they would be the field shows.
    Robot robot;
    const auto parts = [&](double from, double to) {
        return [from, to](Row& row, double from_top) { row.shows = from_top >= from && from_top < to; };
    };
    Candidates c = empty_frame(robot.camera);
    add(c, robot, post_at(2.0, 0.0), parts(0.0, 0.55));
    const int beside = c.segments.back().line;
    Candidates post = empty_frame(robot.camera);
    add(post, robot, post_at(3.0, 0.025));
    for (std::size_t i = 0; i < post.segments.size(); ++i) {
        if (post.segments[i].line <= beside) continue;
        c.segments.push_back(post.segments[i]);
        c.left_edges.push_back(post.left_edges[i]);
        c.right_edges.push_back(post.right_edges[i]);
    }
    const auto fooled = detect(c, robot, robot.told());
    ASSERT_EQ(fooled.size(), 1U);
    EXPECT_NEAR(fooled[0].distance_m, 2.0, 0.1) << "nothing says otherwise";

    for (int y = beside + spacing; y < c.height; y += spacing) {
        const auto here = std::find_if(post.segments.begin(), post.segments.end(),
                                       [&](const CandidateSegment& s) { return s.line == y; });
        if (here == post.segments.end()) {
            c.field.push_back({y, 0, c.width - 1});
            continue;
        }
        c.field.push_back({y, 0, here->start - 1});
        c.field.push_back({y, here->end + 1, c.width - 1});
    }
    const auto posts = detect(c, robot, robot.told());
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_NEAR(posts[0].distance_m, 3.0, 0.1);
}

TEST(UprightDetector, WhereItsColourEndsEarlyThePostIsSoonerAThinnerOne) {
    // Something of its colour stands behind it and makes it wider, but not at its foot.
    Robot robot;
    const double wider = 0.1;
    Candidates c = empty_frame(robot.camera);
    add(c, robot, post_at(1.5, 0.0), [&](Row& row, double from_top) {
        if (from_top < 0.6) row.right += wider * (row.right - row.left);
    });
    const auto view = UprightView::make(robot.camera, robot.told(), 0.26);
    UprightCandidates seen;
    seen.take(c, *view);
    const UprightSize size;
    UprightJudge judge(size);
    const double half = std::asin(size.radius / 1.5);
    const auto score = [&](double right) {
        return judge.judge(seen, *view, {-half, right, 0.0}, 3.0 / robot.camera.fx).score;
    };
    EXPECT_GT(score(half), score(half * (1.0 + 2.0 * wider)));
}

TEST(UprightDetector, APostWithAHiddenFootGoesOnToTheGround) {
    Robot robot;
    const Cylinder post = post_at(3.0, 0.0);
    const auto truth = project_edges(robot.camera, robot.T_BC(), post);
    ASSERT_TRUE(truth);
    Candidates c = empty_frame(robot.camera);
    add(c, robot, post, [](Row& row, double from_top) { row.shows = from_top < 0.55; });
    const double seen_to = c.segments.back().line;
    auto posts = detect(c, robot, robot.told());
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_NEAR(posts[0].left_base.y(), truth->left_base.y(),
                0.06 * (truth->left_base.y() - truth->left_top.y()));

    posts = detect(c, robot, std::nullopt);
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_NEAR(posts[0].left_base.y(), seen_to, spacing) << "nobody knows where the ground is";

    const int field_from = static_cast<int>(seen_to + 0.8 * (truth->left_base.y() - seen_to));
    for (int y = 2; y < c.height; y += spacing)
        if (y > field_from) c.field.push_back({y, 0, c.width - 1});
    posts = detect(c, robot, robot.told());
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_LT(posts[0].left_base.y(), field_from + 1) << "nothing hides it where the field shows";
}

TEST(UprightDetector, LeansAsTheVerticalWasMeasured) {
    // What hides the post's right edge leans into it: the edges that most rows show lean by five degrees.
    Robot robot;
    const auto posts_with = [&](double error) {
        Candidates c = empty_frame(robot.camera);
        add(c, robot, post_at(5.0, 0.0),
            [](Row& row, double from_top) { row.right -= std::max(0.0, from_top - 0.35) * 9.0; });
        return detect(c, robot, robot.told(error));
    };
    const auto posts = posts_with(0.0);
    ASSERT_EQ(posts.size(), 1U);
    const double lean =
        (posts[0].left_top - posts[0].left_base).x() / (posts[0].left_base - posts[0].left_top).y();
    EXPECT_NEAR(lean, 0.0, 0.03);
}

TEST(UprightDetector, TellsLeftFromRightOfAGoalAndLeavesItsCrossbar) {
    Robot robot;
    Candidates c = empty_frame(robot.camera);
    add(c, robot, post_at(4.0, 0.75));
    add(c, robot, post_at(4.0, -0.75));
    Cylinder crossbar{{4.0, 0.75, 0.9}, -Eigen::Vector3d::UnitY(), 1.5, 0.05};
    for (int y = 2; y < c.height; y += spacing) {
        const double slope = (239.5 - y) / robot.camera.fy - std::tan(robot.pitch);
        if (std::abs(slope - (crossbar.base.z() - robot.height) / 4.0) > 0.05 / 4.0) continue;
        c.segments.push_back({Orientation::horizontal, y, 210, 425});
    }
    const auto posts = detect(c, robot, robot.told());
    ASSERT_EQ(posts.size(), 2U);
    EXPECT_EQ(posts[0].side, PostSide::left);
    EXPECT_EQ(posts[1].side, PostSide::right);
    for (const Post& post : posts) EXPECT_NEAR(post.distance_m, std::hypot(4.0, 0.75), 0.05);
}

TEST(UprightDetector, DoesNotTakePolesOfOtherHeightsForPosts) {
    Robot robot;
    for (const double top : {0.4, 2.2}) {
        Candidates c = empty_frame(robot.camera);
        add(c, robot, post_at(3.0, 0.0, top));
        EXPECT_TRUE(detect(c, robot, robot.told()).empty()) << top << " m";
    }
}

TEST(UprightDetector, DoesNotTakeWhatHangsOnAWallForAPost) {
    // As wide and as high as a post two metres away, but hung 60 cm above the ground.
    Robot robot;
    Candidates c = empty_frame(robot.camera);
    Cylinder poster = post_at(2.0, 0.0);
    poster.base.z() = 0.6;
    add(c, robot, poster);
    EXPECT_TRUE(detect(c, robot, robot.told()).empty());
    EXPECT_EQ(detect(c, robot, std::nullopt).size(), 1U) << "nobody knows where the ground is";
}

TEST(UprightDetector, WhatHangsAboveTheFieldsBorderIsLessOfAPostWhereverTheGroundIs) {
    Robot robot;
    robot.pitch = 0.2;
    const auto border = project(robot.camera, robot.T_BC().inverse() * Eigen::Vector3d(3.0, 0.0, 0.0));
    ASSERT_TRUE(border);
    Candidates c = empty_frame(robot.camera);
    for (int y = 2; y < c.height; y += spacing)
        if (y > border->y()) c.field.push_back({y, 0, c.width - 1});
    // As high as this hangs a post six metres away shows little more than a detection needs.
    Candidates with_poster = c;
    Cylinder poster = post_at(6.0, 0.0, 0.42);
    poster.base.z() = 0.68;
    add(with_poster, robot, poster);
    EXPECT_TRUE(detect(with_poster, robot, std::nullopt).empty());
    with_poster.field.clear();
    EXPECT_EQ(detect(with_poster, robot, std::nullopt).size(), 1U) << "nobody knows where the ground is";

    // As far as the border's own row, posts stand on the field; one's foot may be hidden by something.
    for (const double distance : {1.5, 2.9}) {
        Candidates with_post = c;
        for (FieldRun& run : with_post.field)
            run.end = with_post.width / 2 - 60;  // something stands in its columns
        add(with_post, robot, post_at(distance, 0.0),
            [](Row& row, double from_top) { row.shows = from_top < 0.7; });
        EXPECT_EQ(detect(with_post, robot, std::nullopt).size(), 1U) << distance << " m";
    }
}

TEST(UprightDetector, AStickBeforeTheFeetIsNoPostFarAway) {
    // In the picture as wide and as high as a post five metres away; the field reaches farther than the
    // picture.
    Robot robot;
    robot.pitch = 0.45;
    constexpr double scale = 0.6 / 5.0;
    Candidates c = empty_frame(robot.camera);
    add(c, robot, post_at(0.6, 0.0, scale * 0.95, scale * 0.05));
    EXPECT_EQ(detect(c, robot, std::nullopt).size(), 1U) << "nobody knows where the ground is";
    for (int y = 2; y < c.height; y += spacing) c.field.push_back({y, 0, c.width / 2 - 40});
    EXPECT_TRUE(detect(c, robot, std::nullopt).empty());
}

TEST(UprightDetector, AGreenWallHidesNoPostFromAKnownPose) {
    const Robot robot;
    Candidates c = empty_frame(robot.camera);
    add(c, robot, post_at(8.0, 0.0));
    for (int y = 2; y < c.height; y += spacing) {
        c.field.push_back({y, 0, c.width / 2 - 40});
        c.field.push_back({y, c.width / 2 + 40, c.width - 1});
    }
    EXPECT_TRUE(detect(c, robot, std::nullopt).empty())
        << "the scene shows what the field's border would say";
    EXPECT_EQ(detect(c, robot, robot.told()).size(), 1U);
}

TEST(UprightDetector, NeedsNoPose) {
    for (const double roll : {0.0, 15.0, -15.0}) {
        Robot robot;
        robot.roll = roll * degree;
        Candidates c = empty_frame(robot.camera);
        add(c, robot, post_at(2.5, 0.6));
        add(c, robot, post_at(2.5, -0.9));
        const auto posts = detect(c, robot, std::nullopt);
        ASSERT_EQ(posts.size(), 2U) << roll;
        EXPECT_NEAR(posts[0].distance_m, std::hypot(2.5, 0.6), 0.1);
        EXPECT_NEAR(posts[1].distance_m, std::hypot(2.5, 0.9), 0.1);
    }
}

TEST(UprightDetector, FollowsALens) {
    Robot robot;
    robot.camera.distortion = {-0.2, 0.05, 0.0, 0.0, 0.0};
    const Cylinder post = post_at(2.0, 0.8);
    Robot plain;
    Candidates drawn = empty_frame(plain.camera);
    add(drawn, plain, post);
    Candidates c = empty_frame(robot.camera);
    for (std::size_t i = 0; i < drawn.left_edges.size(); ++i) {
        // Rows of the bent picture: where its own scan-lines meet the bent edges.
        const auto bent = [&](const Eigen::Vector2d& p) {
            return pixel_from_normalised(robot.camera, normalised_from_pixel(plain.camera, p));
        };
        const Eigen::Vector2d l = bent(drawn.left_edges[i]), r = bent(drawn.right_edges[i]);
        const int y = static_cast<int>(std::lround(l.y()));
        c.segments.push_back(
            {Orientation::horizontal, y, static_cast<int>(std::ceil(l.x())), static_cast<int>(r.x())});
        c.left_edges.emplace_back(l.x(), y);
        c.right_edges.emplace_back(r.x(), y);
    }
    const auto posts = detect(c, robot, robot.told());
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_NEAR(posts[0].distance_m, std::hypot(2.0, 0.8), 0.05);
}

TEST(UprightDetector, ReportsAPostThatTheBorderCuts) {
    Robot robot;
    Candidates c = empty_frame(robot.camera);
    add(c, robot, post_at(1.5, -0.87));
    const auto posts = detect(c, robot, robot.told());
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_TRUE(posts[0].has(post_flag::right_edge_missing));
    EXPECT_TRUE(posts[0].has(post_flag::no_distance));
}

TEST(UprightDetector, FindsNothingInNothingAndNoise) {
    Robot robot;
    EXPECT_TRUE(detect(Candidates{}, robot, robot.told()).empty());
    EXPECT_TRUE(detect(empty_frame(robot.camera), robot, std::nullopt).empty());
    Random random(3);
    for (int frame = 0; frame < 20; ++frame) {
        Candidates c = empty_frame(robot.camera);
        for (int y = 2; y < c.height; y += spacing) {
            const int at = static_cast<int>(random.index(600));
            const int length = 4 + static_cast<int>(random.index(30));
            c.segments.push_back({Orientation::horizontal, y, at, at + length});
            c.left_edges.emplace_back(at - 0.5, y);
            c.right_edges.emplace_back(at + length + 0.5, y);
        }
        EXPECT_TRUE(detect(c, robot, robot.told()).empty()) << frame;
    }
}

TEST(UprightDetector, BearsLensesThatFoldBackAndNumbersWithoutMeasure) {
    Robot robot;
    robot.camera.fx = robot.camera.fy = 300.0;
    Candidates c = empty_frame(robot.camera);
    for (int y = 2; y < c.height; y += spacing) {
        for (int x = 5; x < 600; x += 90) {
            c.segments.push_back({Orientation::horizontal, y, x, x + 20});
            c.left_edges.emplace_back(x - 0.5, y);
            c.right_edges.emplace_back(x + 20.5, y);
        }
    }
    for (const double k1 : {-0.4, -3.0, 1e300}) {
        robot.camera.distortion = {k1, 0.0, 0.0, 0.0, 0.0};
        for (const Post& post : detect(c, robot, robot.told())) EXPECT_TRUE(post.left_top.allFinite()) << k1;
    }
    robot.camera.distortion = {};
    robot.camera.cx = 1e308;
    robot.camera.fx = 0.1;
    detect(c, robot, robot.told());
    robot.camera = {};
    robot.camera.fx = robot.camera.fy = 1e-3;
    CameraPose pose = robot.told();
    pose.covariance.setZero();
    pose.T_BC.translation().z() = 1e6;
    detect(c, robot, pose);
}

TEST(UprightDetector, ManyPointsOfNoiseAreThinnedOut) {
    Robot robot;
    Random random(5);
    Candidates c = empty_frame(robot.camera);
    for (int i = 0; i < 100'000; ++i) {
        const int y = 2 + spacing * static_cast<int>(random.index(119));
        c.left_edges.emplace_back(random.uniform(0.0, 639.0), y);
        c.right_edges.emplace_back(random.uniform(0.0, 639.0), y);
    }
    const auto view = UprightView::make(robot.camera, robot.told(), 0.26);
    UprightCandidates seen;
    seen.take(c, *view);
    for (const auto* points : {&seen.left, &seen.right}) EXPECT_EQ(points->size(), 4000U);
    EXPECT_TRUE(detect(c, robot, robot.told()).empty());
}

TEST(UprightDetector, ThereIsOnePostInOnePlace) {
    // Edges of a far post before the colour of a near one, which shows its own on some rows: either would do
    // alone.
    Robot robot;
    const auto near = [](Candidates& c, const Robot& r) {
        add(c, r, post_at(2.0, 0.0),
            [](Row& row, double from_top) { row.left_edge = row.right_edge = from_top > 0.65; });
    };
    const auto far = [](Candidates& c, const Robot& r) { add(c, r, post_at(6.0, 0.0)); };
    Candidates one = empty_frame(robot.camera), other = empty_frame(robot.camera);
    near(one, robot);
    far(other, robot);
    ASSERT_EQ(detect(one, robot, robot.told()).size(), 1U);
    ASSERT_EQ(detect(other, robot, robot.told()).size(), 1U);
    Candidates both = empty_frame(robot.camera);
    near(both, robot);
    far(both, robot);
    EXPECT_EQ(detect(both, robot, robot.told()).size(), 1U);
}

TEST(UprightDetector, BearsPosesThatMakeNoSense) {
    Robot robot;
    Candidates c = empty_frame(robot.camera);
    add(c, robot, post_at(3.0, 0.0));
    CameraPose pose = robot.told();
    pose.T_BC.translation().z() = std::nan("");
    EXPECT_EQ(detect(c, robot, pose).size(), 1U) << "as without a pose";
    pose = robot.told();
    pose.covariance.setConstant(std::nan(""));
    EXPECT_EQ(detect(c, robot, pose).size(), 1U);
    pose = robot.told();
    pose.covariance.setZero();
    EXPECT_EQ(detect(c, robot, pose).size(), 1U) << "known exactly";
    pose.T_BC = camera_in_body(0.42, 0.0, 0.5 * std::numbers::pi);
    EXPECT_TRUE(detect(c, robot, pose).empty()) << "looks along the vertical";
}

TEST(UprightDetector, RemembersNothingAndAllocatesNothingOnceWarm) {
    Robot robot;
    UprightDetector detector({}, Field{});
    std::vector<Candidates> frames;
    for (const double distance : {0.7, 1.5, 3.0, 6.0}) {
        frames.push_back(empty_frame(robot.camera));
        add(frames.back(), robot, post_at(distance, 0.0));
        add(frames.back(), robot, post_at(distance, 0.4 * distance));
    }
    frames.push_back(empty_frame(robot.camera));
    add(frames.back(), robot, post_at(1.5, -0.87));
    for (const Candidates& c : frames) detector.detect(c, robot.camera, robot.told());
    for (const Candidates& c : frames) {
        const std::vector<Post> fresh = detect(c, robot, robot.told());
        const std::vector<Post>& again = detector.detect(c, robot.camera, robot.told());
        ASSERT_EQ(fresh.size(), again.size());
        for (std::size_t i = 0; i < fresh.size(); ++i) {
            EXPECT_EQ(fresh[i].left_top, again[i].left_top);
            EXPECT_EQ(fresh[i].distance_m, again[i].distance_m);
        }
    }
    if (!test::allocations_are_counted()) GTEST_SKIP() << "another heap than the C library's";
    const test::AllocationCount count;
    for (const Candidates& c : frames) detector.detect(c, robot.camera, robot.told());
    EXPECT_EQ(count.so_far(), 0U);
}

}  // namespace
}  // namespace goalmouth
