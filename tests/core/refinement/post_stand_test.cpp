#include "core/refinement/post_stand.h"

#include "core/geometry/cylinder.h"
#include "tests/core/refinement/drawn_post.h"

#include <gtest/gtest.h>

namespace goalmouth::test {
namespace {

struct Seen {
    DrawnPost scene;
    PostSilhouette post;
    PostExtent extent;
    CameraStance stance;
};

/// A post whose length is the goal's, with its silhouette so many times as wide as it is.
Seen seen(double wider) {
    Seen result;
    const Field field;
    result.scene.length = field.goal_height + 0.5 * field.post_diameter;
    result.scene.distance = 3.0;
    const auto truth = silhouette(result.scene.cylinder(), result.scene.T_WC());
    const Eigen::Vector3d up = result.scene.T_WC().linear().transpose() * Eigen::Vector3d::UnitZ();
    result.post = silhouette_between(truth->left_plane, truth->right_plane, up);
    result.post.half_angle *= wider;
    const Post corners = result.scene.found();
    result.extent.first_row = static_cast<int>(corners.left_top.y());
    result.extent.last_row = static_cast<int>(corners.left_base.y());
    result.extent.top_seen = result.extent.base_seen = true;
    result.stance = {result.scene.height, 1e-4, Eigen::Vector3d::Zero()};
    return result;
}

PostStand stand_of(const Seen& s, bool pose) {
    return post_stand(s.post, s.extent, pose ? std::optional(s.stance) : std::nullopt, 0.0175, s.scene.camera,
                      {});
}

TEST(PostStand, OfATrueSilhouetteReachesItsTopAndDoesNotSink) {
    for (const bool pose : {true, false}) {
        const PostStand stand = stand_of(seen(1.0), pose);
        EXPECT_FALSE(stand.sinks);
        EXPECT_TRUE(stand.reaches(1.0)) << pose;
        EXPECT_FALSE(stand.reaches(2.0)) << pose;
        ASSERT_TRUE(stand.crossbar_row(1.0));
        const Seen s = seen(1.0);
        EXPECT_GT(*stand.crossbar_row(1.0), s.extent.first_row + 10);
        EXPECT_LT(*stand.crossbar_row(1.0), s.extent.first_row + 50);
    }
}

TEST(PostStand, ThatIsTooNarrowReachesWhereOneAsWideAsThePostWould) {
    for (const bool pose : {true, false}) {
        const PostStand stand = stand_of(seen(0.5), pose);
        EXPECT_FALSE(stand.reaches(1.0)) << pose;
        EXPECT_TRUE(stand.reaches(2.0)) << pose;
    }
}

TEST(PostStand, ThatIsFarTooNarrowSinks) {
    EXPECT_TRUE(stand_of(seen(0.3), true).sinks);
    EXPECT_FALSE(stand_of(seen(0.3), false).sinks) << "nothing says how high the camera is";
    EXPECT_FALSE(stand_of(seen(2.0), true).sinks) << "its foot may be hidden";
}

TEST(PostStand, ThatIsFarTooNarrowOvertopsAPostSoFarAway) {
    EXPECT_TRUE(stand_of(seen(0.3), true).overtops);
    EXPECT_FALSE(stand_of(seen(0.3), false).overtops) << "nothing says how high the camera is";
    EXPECT_FALSE(stand_of(seen(1.0), true).overtops);
    EXPECT_FALSE(stand_of(seen(2.0), true).overtops) << "its top may be hidden";
    Seen cut = seen(0.3);
    cut.extent.top_seen = false;
    EXPECT_FALSE(stand_of(cut, true).overtops) << "where its colour ends is not seen";
}

TEST(PostStand, OfAPostCutAtBothEndsKnowsNothingWithoutAPose) {
    Seen s = seen(1.0);
    s.extent.top_seen = s.extent.base_seen = false;
    const PostStand stand = stand_of(s, false);
    EXPECT_FALSE(stand.crossbar_row(1.0));
    EXPECT_FALSE(stand.reaches(1.0));
}

}  // namespace
}  // namespace goalmouth::test
