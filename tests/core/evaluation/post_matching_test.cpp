#include "core/evaluation/post_matching.h"

#include "tests/support/upright_post.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::post_at;
using test::truth_at;

PostMatching match(const std::vector<ReferencePost>& truth, const std::vector<Post>& posts,
                   const MatchingRule& rule = {}) {
    return match_posts(truth, posts, rule);
}

TEST(PostMatching, FindsAPostWhoseEdgesLieWithinAQuarterOfItsWidth) {
    const std::vector<ReferencePost> truth = {truth_at(200, 220)};
    EXPECT_EQ(match(truth, {post_at(205, 225)}).found_count(truth), 1U);
    EXPECT_EQ(match(truth, {post_at(205.01, 225)}).found_count(truth), 0U);
    EXPECT_EQ(match(truth, {post_at(200, 214.99)}).found_count(truth), 0U);
    EXPECT_EQ(match(truth, {post_at(195, 225)}).found_count(truth), 1U);
    EXPECT_EQ(match(truth, {post_at(194.99, 220)}).found_count(truth), 0U);
}

TEST(PostMatching, WidensTheLimitToTheFloorOnly) {
    const std::vector<ReferencePost> truth = {truth_at(200, 208)};
    const MatchingRule by_hand{.floor = 3.0};
    EXPECT_EQ(match(truth, {post_at(202.5, 208)}).found_count(truth), 0U);
    EXPECT_EQ(match(truth, {post_at(203, 208)}, by_hand).found_count(truth), 1U);
    EXPECT_EQ(match(truth, {post_at(203.1, 208)}, by_hand).found_count(truth), 0U);
}

TEST(PostMatching, LooksAtBothHeights) {
    const std::vector<ReferencePost> truth = {truth_at(200, 220)};
    Post leaning = post_at(200, 220);
    leaning.left_base.x() += 12.0;  // 9 px off at three quarters, 3 at one
    leaning.right_base.x() += 12.0;
    EXPECT_EQ(match(truth, {leaning}).found_count(truth), 0U);
    leaning = post_at(200, 220);
    leaning.left_top.x() -= 12.0;
    EXPECT_EQ(match(truth, {leaning}).found_count(truth), 0U);
    leaning.left_top.x() += 6.0;  // 4.5 px
    EXPECT_EQ(match(truth, {leaning}).found_count(truth), 1U);
}

TEST(PostMatching, MeasuresALeaningPostAlongTheRow) {
    ReferencePost truth{{200, 100}, {300, 300}, {240, 110}, {340, 310}};
    Post same;
    same.left_top = {200, 100};
    same.left_base = {300, 300};
    same.right_top = {240, 110};
    same.right_base = {340, 310};
    const auto offsets = edge_offsets(truth, same);
    EXPECT_NEAR(offsets[0], 0.0, 1e-12);
    EXPECT_NEAR(offsets[1], 0.0, 1e-12);
    for (auto* corner : {&same.left_top, &same.left_base, &same.right_top, &same.right_base})
        corner->x() += 8.0;
    EXPECT_NEAR(edge_offsets(truth, same)[0], 8.0, 1e-12);
    EXPECT_EQ(match({truth}, {same}).wrong_count(), 0U) << "true width along the row: 35 px";
    for (auto* corner : {&same.left_top, &same.left_base, &same.right_top, &same.right_base})
        corner->x() += 0.8;
    EXPECT_EQ(match({truth}, {same}).wrong_count(), 1U);
}

TEST(PostMatching, ExtendsADetectionThatCoversHalfTheLength) {
    const std::vector<ReferencePost> truth = {truth_at(200, 220)};
    EXPECT_EQ(match(truth, {post_at(200, 220, 100, 200)}).found_count(truth), 1U);
    EXPECT_EQ(match(truth, {post_at(200, 220, 150, 250)}).found_count(truth), 1U);
    EXPECT_EQ(match(truth, {post_at(200, 220, 100, 199)}).found_count(truth), 0U);
    EXPECT_EQ(match(truth, {post_at(200, 220, 0, 190)}).found_count(truth), 0U)
        << "what sticks out above does not cover";
    EXPECT_EQ(match(truth, {post_at(200, 220, 0, 1000)}).found_count(truth), 1U);
}

TEST(PostMatching, RefusesSwappedEdges) {
    const std::vector<ReferencePost> truth = {truth_at(200, 220)};
    const auto matching = match(truth, {post_at(220, 200)});
    EXPECT_EQ(matching.found_count(truth), 0U);
    EXPECT_EQ(matching.wrong_count(), 1U);
    EXPECT_TRUE(matching.identified[0]) << "it still means that post";
    EXPECT_DOUBLE_EQ(edge_offsets(truth[0], post_at(220, 200))[0], 20.0);
    EXPECT_DOUBLE_EQ(edge_offsets(truth[0], post_at(220, 200))[1], -20.0);
}

TEST(PostMatching, ShowsAShiftOfOnePixel) {
    const auto offsets = edge_offsets(truth_at(200, 220), post_at(201, 221));
    EXPECT_DOUBLE_EQ(offsets[0], 1.0);
    EXPECT_DOUBLE_EQ(offsets[1], 1.0);
}

TEST(PostMatching, GivesAPostToTheBestOfSeveralDetections) {
    const std::vector<ReferencePost> truth = {truth_at(200, 220)};
    const auto matching = match(truth, {post_at(203, 222), post_at(201, 220), post_at(200, 224)});
    EXPECT_EQ(matching.found[0], 1U);
    EXPECT_EQ(matching.verdicts, (std::vector<Verdict>{Verdict::wrong, Verdict::found, Verdict::wrong}));
}

TEST(PostMatching, GivesADetectionToOnePostOnly) {
    const std::vector<ReferencePost> truth = {truth_at(200, 220), truth_at(203, 223)};
    const auto matching = match(truth, {post_at(202.5, 222.5)});
    EXPECT_FALSE(matching.found[0]);
    EXPECT_EQ(matching.found[1], 0U);
    EXPECT_EQ(matching.found_count(truth), 1U);
    EXPECT_EQ(matching.wrong_count(), 0U);
    const auto both = match(truth, {post_at(202.5, 222.5), post_at(203.2, 223.2)});
    EXPECT_EQ(both.found_count(truth), 2U);
    EXPECT_EQ(both.found[0], 0U);
}

TEST(PostMatching, IdentifiesByTheMiddleOfEither) {
    const std::vector<ReferencePost> truth = {truth_at(200, 220)};
    EXPECT_EQ(match(truth, {post_at(215, 280)}).identified[0], std::nullopt);
    EXPECT_EQ(match(truth, {post_at(205, 230)}).identified[0], 0U) << "its middle lies in the post";
    EXPECT_EQ(match(truth, {post_at(190, 260)}).identified[0], 0U) << "it holds the post's middle";
    EXPECT_EQ(match(truth, {post_at(190, 260, 250, 290)}).identified[0], std::nullopt);
    EXPECT_EQ(match(truth, {post_at(190, 260)}).wrong_count(), 1U) << "meant, but not found";
    EXPECT_EQ(match(truth, {post_at(150, 250), post_at(195, 235)}).identified[0], 1U) << "the nearest";
}

TEST(PostMatching, AsksNeitherForNorAgainstAPostThatDoesNotCount) {
    std::vector<ReferencePost> truth = {truth_at(200, 220), truth_at(400, 420)};
    truth[1].counts = false;
    const auto matching = match(truth, {post_at(200, 220), post_at(401, 421), post_at(398, 440)});
    EXPECT_EQ(matching.found_count(truth), 1U);
    EXPECT_EQ(matching.verdicts, (std::vector<Verdict>{Verdict::found, Verdict::ignored, Verdict::wrong}));
    EXPECT_EQ(match(truth, {post_at(390, 440)}).verdicts[0], Verdict::ignored) << "by identification";
}

TEST(PostMatching, IgnoresWhatIsCentredInABoxButNotWhatFindsAPost) {
    const std::vector<ReferencePost> truth = {truth_at(200, 220)};
    const std::vector<Eigen::AlignedBox2d> boxes = {{Eigen::Vector2d(150, 0), Eigen::Vector2d(300, 400)}};
    const std::vector<Post> posts = {post_at(200, 220), post_at(250, 270), post_at(500, 520)};
    const auto matching = match_posts(truth, posts, {}, boxes);
    EXPECT_EQ(matching.verdicts, (std::vector<Verdict>{Verdict::found, Verdict::ignored, Verdict::wrong}));
}

TEST(PostMatching, TakesLevelEdgesAndNonsenseForWrong) {
    const std::vector<ReferencePost> truth = {truth_at(200, 220)};
    Post level = post_at(200, 220);
    level.left_base = {260, 100};
    EXPECT_TRUE(std::isinf(edge_offsets(truth[0], level)[0]));
    Post nonsense = post_at(200, 220);
    nonsense.left_base.x() = std::numeric_limits<double>::quiet_NaN();
    const auto matching = match(truth, {level, nonsense, Post{}});
    EXPECT_EQ(matching.found_count(truth), 0U);
    EXPECT_EQ(matching.wrong_count(), 3U);
}

TEST(PostMatching, HasAnAnswerWithoutPosts) {
    EXPECT_EQ(match({}, {post_at(1, 2)}).wrong_count(), 1U);
    const std::vector<ReferencePost> truth = {truth_at(200, 220)};
    EXPECT_EQ(match(truth, {}).found_count(truth), 0U);
    EXPECT_EQ(match({truth_at(1, 2, 5, 5)}, {post_at(1, 2, 5, 5)}).wrong_count(), 1U) << "no length";
}

}  // namespace
}  // namespace goalmouth
