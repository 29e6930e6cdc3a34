#include "core/refinement/edge_rivals.h"

#include "core/refinement/foot_ground.h"
#include "core/refinement/post_refiner.h"
#include "tests/core/refinement/drawn_post.h"

#include <gtest/gtest.h>

namespace goalmouth::test {
namespace {

const Levels grey{150, 150, 155}, carpet{52, 122, 62}, robot{45, 45, 50};

/// A post of a goal with the ground about its foot.
struct Goal {
    DrawnPost scene = small_scene();
    PostEdges edges;
    double border;  // px, the row where the carpet ends

    Goal() {
        scene.length = 0.95;
        scene.noise = 2.0;
        edges.at = scene.found();
        border = edges.row(0.94);
        scene.behind = [this](double, double y) { return y > border ? carpet : grey; };
    }
    /// A thing of the post's colour behind it, down to a share of its length and so far out on its right.
    void stand_behind(double share, double out, double light) {
        scene.behind = [this, share, out, light](double x, double y) -> Levels {
            const bool thing = y < edges.row(share) && x > edges.left(y) + 4.0 && x < edges.right(y) + out;
            return thing ? light * scene.post : y > border ? carpet : grey;
        };
    }
    /// Something before it, from a share of its length down, that leaves so many px on its left.
    void stand_before(double share, double leaves) {
        scene.before = [this, share, leaves](double x, double y) -> std::optional<Levels> {
            const bool hides =
                y > edges.row(share) && x > edges.left(y) + leaves && x < edges.right(y) + 25.0;
            return hides ? std::optional(robot) : std::nullopt;
        };
    }
    RefinedPost refine(double right_moved) const {
        PostRefiner refiner({}, {});
        const YuyvImage image = scene.draw();
        return refiner.refine(image.view(), {scene.found(0.0, right_moved)}, scene.camera, scene.pose())
            .front();
    }
};

TEST(EdgeRivals, ThingOfThePostsColourBehindMostOfItIsNotThePost) {
    for (const double out : {4.0, 6.0, 10.0}) {
        Goal goal;
        goal.stand_behind(0.7, out, 0.8);
        const RefinedPost refined = goal.refine(out);
        ASSERT_TRUE(refined.post.has(post_flag::refined)) << out << refined.reason;
        EXPECT_NEAR(refined.post.distance_m, goal.scene.distance, 0.03) << out;
    }
}

TEST(EdgeRivals, GroundBesideTheFootTellsWhereNoLineDoes) {
    // A post lit from everywhere before a thing as bright: there is no line between them.
    Goal goal;
    goal.scene.limb_darkening = 0.0;
    goal.stand_behind(0.75, 8.0, 1.0);
    const RefinedPost refined = goal.refine(8.0);
    ASSERT_TRUE(refined.post.has(post_flag::refined)) << refined.reason;
    EXPECT_NEAR(refined.post.distance_m, goal.scene.distance, 0.03);
}

TEST(EdgeRivals, WhatHidesTheFootDoesNotMakeThePostNarrow) {
    for (const double share : {0.6, 0.75}) {
        Goal goal;
        goal.stand_before(share, 9.0);
        const RefinedPost refined = goal.refine(0.0);
        ASSERT_TRUE(refined.post.has(post_flag::refined)) << share << refined.reason;
        EXPECT_NEAR(refined.post.distance_m, goal.scene.distance, 0.03) << share;
    }
}

TEST(EdgeRivals, WhatIsAsHighAsANearerPostIsNoFarOneThatGoesOnAboveItsTop) {
    // All but a strip of the lower rows is hidden, and the strip is what a detector found.
    Goal goal;
    goal.scene.length = Field().goal_height + goal.scene.radius;
    goal.scene.pitch = 0.0;  // its top is in the picture
    goal.edges.at = goal.scene.found();
    goal.border = goal.edges.row(0.94);
    goal.stand_before(0.35, 5.0);
    const RefinedPost refined = goal.refine(-13.0);
    ASSERT_TRUE(refined.post.has(post_flag::refined)) << refined.reason;
    EXPECT_NEAR(refined.post.distance_m, goal.scene.distance, 0.05);
}

TEST(EdgeRivals, PlainPostHasNone) {
    const Goal goal;
    const YuyvImage image = goal.scene.draw();
    RunEnds ends;
    ends.tolerance = 2.0;
    ends.spread = 1.2;
    for (int y = 60; y < 160; ++y) ends.rows.push_back({y, goal.edges.right(y), 18.0, 0.1});
    const RivalVerdict verdict = judge_rivals(image.view(), ends, 1, {}, 0.85);
    EXPECT_FALSE(verdict.moved);
    EXPECT_EQ(verdict.here, 100);
    EXPECT_EQ(verdict.undecided, 0);
    EXPECT_FALSE(judge_rivals(image.view(), {}, 1, {}, 0.85).moved);
}

TEST(EdgeRivals, RowsThatEndFarOutSpeakAgainstAnEdgeWhereNoLineIsSeen) {
    const Goal goal;
    const YuyvImage image = goal.scene.draw();
    RunEnds ends;
    ends.tolerance = 2.0;
    ends.spread = 1.2;
    ends.near_by = 11.0;
    for (int y = 60; y < 160; ++y) {
        const double strip = 5.0, edge = goal.edges.left(y) + strip;
        ends.rows.push_back({y, edge, strip, y < 120 ? goal.edges.right(y) - edge : 0.0});
    }
    const RivalVerdict verdict = judge_rivals(image.view(), ends, 1, {}, 0.85);
    EXPECT_FALSE(verdict.moved);
    EXPECT_EQ(verdict.here, 40);
    EXPECT_EQ(verdict.undecided, 60);
    EXPECT_DOUBLE_EQ(verdict.rival(), 1.5);
}

TEST(FootGround, IsBesideAnEdgeThatComesDownToTheFoot) {
    for (const bool hidden : {false, true}) {
        Goal goal;
        if (hidden) goal.stand_before(0.8, 9.0);
        const YuyvImage image = goal.scene.draw();
        std::vector<LinePoint> edge;
        for (int y = static_cast<int>(goal.edges.row(0.8)); y < goal.edges.row(1.0); ++y)
            edge.push_back({y, hidden ? goal.edges.left(y) + 9.0 : goal.edges.right(y)});
        EXPECT_EQ(ends_on_ground(image.view(), edge, 1, hidden ? 9.0 : 18.0, 0.85), !hidden);
    }
    EXPECT_FALSE(ends_on_ground(Goal().scene.draw().view(), {}, 1, 18.0, 0.85));
}

TEST(FootGround, IsSeenInAFewOfALargePicturesRows) {
    const Goal goal;
    const YuyvImage image = goal.scene.draw();
    std::vector<LinePoint> edge;
    const int foot = static_cast<int>(goal.edges.row(1.0));
    for (int y = foot - 54; y <= foot; y += 9) edge.push_back({y, goal.edges.right(y)});
    EXPECT_TRUE(ends_on_ground(image.view(), edge, 1, 18.0, 0.85));
}

TEST(FootGround, IsNotToldFromGroundWithoutColour) {
    Goal goal;
    goal.scene.behind = [](double, double) { return grey; };
    const YuyvImage image = goal.scene.draw();
    std::vector<LinePoint> edge;
    for (int y = static_cast<int>(goal.edges.row(0.8)); y < goal.edges.row(1.0); ++y)
        edge.push_back({y, goal.edges.right(y)});
    EXPECT_FALSE(ends_on_ground(image.view(), edge, 1, 18.0, 0.85));
}

}  // namespace
}  // namespace goalmouth::test
