#include "core/detection/upright_evidence.h"

#include "core/geometry/cylinder.h"
#include "tests/core/detection/upright_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

namespace goalmouth::test {
namespace {

TEST(UprightEvidence, TakesAnEdgeThatIsSeenInAThirdOfItsRows) {
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

TEST(UprightEvidence, AnEdgeInAnEighthOfTheRowsIsEnoughNextToAWholeOne) {
    Robot robot;
    Candidates c = empty_frame(robot.camera);
    add(c, robot, post_at(3.0, 0.0), [&](Row& row, double from_top) {
        if (from_top < 0.875) row.left -= 70.0;
    });
    const auto posts = detect(c, robot, robot.told());
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_NEAR(posts[0].distance_m, 3.0, 0.05);
}

TEST(UprightEvidence, FindsAPostOfWhichTheLowerHalfIsHidden) {
    Robot robot;
    for (const double distance : {1.5, 3.0, 6.0}) {
        Candidates c = empty_frame(robot.camera);
        add(c, robot, post_at(distance, 0.0), [](Row& row, double from_top) { row.shows = from_top < 0.55; });
        const auto posts = detect(c, robot, robot.told());
        ASSERT_EQ(posts.size(), 1U) << distance;
        EXPECT_NEAR(posts[0].distance_m, distance, 0.03 * distance);
    }
}

TEST(UprightEvidence, TheFieldThatShowsBetweenItsEdgesTellsThatThereIsNoPost) {
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

TEST(UprightEvidence, WhereItsColourEndsEarlyThePostIsSoonerAThinnerOne) {
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

TEST(UprightEvidence, APostWithAHiddenFootGoesOnToTheGround) {
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

TEST(UprightEvidence, DoesNotTakePolesOfOtherHeightsForPosts) {
    Robot robot;
    for (const double top : {0.4, 2.2}) {
        Candidates c = empty_frame(robot.camera);
        add(c, robot, post_at(3.0, 0.0, top));
        EXPECT_TRUE(detect(c, robot, robot.told()).empty()) << top << " m";
    }
}

TEST(UprightEvidence, DoesNotTakeWhatHangsOnAWallForAPost) {
    // As wide and as high as a post two metres away, but hung 60 cm above the ground.
    Robot robot;
    Candidates c = empty_frame(robot.camera);
    Cylinder poster = post_at(2.0, 0.0);
    poster.base.z() = 0.6;
    add(c, robot, poster);
    EXPECT_TRUE(detect(c, robot, robot.told()).empty());
    EXPECT_EQ(detect(c, robot, std::nullopt).size(), 1U) << "nobody knows where the ground is";
}

TEST(UprightEvidence, WhatHangsAboveTheFieldsBorderIsLessOfAPostWhereverTheGroundIs) {
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

TEST(UprightEvidence, AStickBeforeTheFeetIsNoPostFarAway) {
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

TEST(UprightEvidence, AGreenWallHidesNoPostFromAKnownPose) {
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

}  // namespace
}  // namespace goalmouth::test
