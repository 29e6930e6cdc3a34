#include "core/refinement/camera_response.h"

#include "core/refinement/post_refiner.h"
#include "core/refinement/response_evidence.h"
#include "tests/core/refinement/drawn_post.h"

#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::DrawnPost;
using test::Levels;

/// A yellow post in light before a bright wall, at six metres nine pixels wide.
DrawnPost before_a_wall(bool coded) {
    DrawnPost scene;
    scene.distance = 6.0;
    scene.coded = coded;
    if (coded) scene.post = {204, 133, 6};
    scene.behind = [](double, double y) { return y < 300.0 ? Levels(115, 115, 122) : Levels(11, 51, 14); };
    return scene;
}

double relative_error(const DrawnPost& scene, const std::string& response) {
    RefinementParameters parameters;
    parameters.response = response;
    PostRefiner refiner(parameters, {});
    const YuyvImage image = scene.draw();
    const RefinedPost found = refiner.refine(image.view(), {scene.found()}, scene.camera, scene.pose())[0];
    EXPECT_TRUE(found.post.has(post_flag::refined)) << found.reason;
    return (found.post.distance_m - scene.distance) / scene.distance;
}

TEST(CameraResponse, LightAndLevelUndoEachOther) {
    EXPECT_EQ(light_of_level(0.0F), 0.0F);
    EXPECT_NEAR(light_of_level(1.0F), 1.0F, 1e-6F);
    for (const PairColour& level : {PairColour(200.0F, -40.0F, 10.0F), PairColour(90.0F, 20.0F, -15.0F)})
        EXPECT_LT((level_of_light(light_of_level(level)) - level).norm(), 1.0F);
    EXPECT_NEAR(255.0F * light_of_level(188.0F / 255.0F), 127.5F, 1.5F) << "half the light is level 188";
}

TEST(CameraResponse, APairIsTheMeanOfItsPixels) {
    const std::uint8_t row[] = {10, 120, 200, 140, 30, 130, 60, 120};
    EXPECT_EQ(PairRow(row, 2, CameraResponse::linear)[0], PairColour(105.0F, -8.0F, 12.0F));
    const std::uint8_t grey[] = {0, 128, 255, 128};
    EXPECT_NEAR(PairRow(grey, 1, CameraResponse::srgb)[0].x(), 127.5F, 0.1F)
        << "light, not levels, is averaged";
}

TEST(CameraResponse, PairsAddUpToTheSumOfTheirColours) {
    std::uint8_t row[4 * 23];
    for (std::size_t i = 0; i < sizeof row; ++i) row[i] = static_cast<std::uint8_t>(37 * i + i * i / 5);
    for (const CameraResponse response : {CameraResponse::linear, CameraResponse::srgb}) {
        const PairRow pairs(row, 23, response);
        for (const auto& [first, last] :
             {std::pair(0, 22), std::pair(3, 3), std::pair(5, 17), std::pair(7, 6)}) {
            PairColour expected(1.0F, -2.0F, 3.0F), sum = expected;
            for (int pair = first; pair <= last; ++pair) expected += pairs[pair];
            pairs.add(first, last, sum);
            EXPECT_LT((sum - expected).norm(), 1e-3F) << first << " to " << last;
        }
    }
}

TEST(CameraResponse, CodedLightIsUndoneUnasked) {
    EXPECT_GT(relative_error(before_a_wall(true), "linear"), 0.03) << "the scene shows what there is to undo";
    EXPECT_LT(std::abs(relative_error(before_a_wall(true), "srgb")), 0.008);
    EXPECT_LT(std::abs(relative_error(before_a_wall(true), "auto")), 0.008);
}

TEST(CameraResponse, LevelsInProportionToLightAreLeftAlone) {
    EXPECT_LT(std::abs(relative_error(before_a_wall(false), "linear")), 0.006);
    EXPECT_EQ(relative_error(before_a_wall(false), "auto"), relative_error(before_a_wall(false), "linear"));
}

/// Rows that show such a share of the bow, more or less.
void show(BowEvidence& evidence, double share, double scatter) {
    constexpr int rows = 100;
    constexpr double information = 4.0;
    for (int i = 0; i < rows; ++i)
        evidence.add((share + (i % 2 == 0 ? scatter : -scatter)) * information, information);
}

BowEvidence bow(double share, double scatter) {
    BowEvidence evidence;
    show(evidence, share, scatter);
    return evidence;
}

TEST(BowEvidence, HasTheSigmaThatItsRowsShow) {
    EXPECT_NEAR(bow(0.9, 0.3).share(), 0.9, 1e-9);
    EXPECT_NEAR(bow(0.9, 0.3).sigma(), 0.03, 1e-3);
}

TEST(BowEvidence, OfOneEdgeIsNeverBeyondDoubt) {
    EXPECT_GT(bow(1.0, 0.1).odds(), 2.0);
    EXPECT_LT(bow(1.0, 0.1).odds(), 4.0);
    EXPECT_NEAR(bow(1.0, 0.1).odds(), -bow(0.0, 0.1).odds(), 0.1);
    EXPECT_NEAR(bow(5.0, 0.1).odds(), 0.0, 1e-9);
    EXPECT_EQ(BowEvidence().odds(), 0.0);
}

TEST(ResponseEvidence, NeedsTheBowOnBothSides) {
    EXPECT_EQ(ResponseEvidence(bow(0.9, 0.3), bow(0.9, 0.3)).response(), CameraResponse::srgb);
    // Something stands beside a post; there is but one edge; nothing is known.
    EXPECT_EQ(ResponseEvidence(bow(1.2, 0.3), bow(0.2, 0.3)).response(), CameraResponse::linear);
    EXPECT_EQ(ResponseEvidence(bow(1.0, 0.3), BowEvidence()).response(), CameraResponse::linear);
    EXPECT_EQ(ResponseEvidence().response(), CameraResponse::linear);
}

TEST(ResponseEvidence, OfOnePostYieldsToAnotherThatHasNoBow) {
    ResponseEvidence evidence(bow(0.9, 0.3), bow(0.9, 0.3));
    evidence += ResponseEvidence(bow(0.05, 0.3), bow(-0.1, 0.3));
    EXPECT_EQ(evidence.response(), CameraResponse::linear);
}

TEST(ResponseEvidence, IsOpenAsLongAsMoreEdgesCanTell) {
    EXPECT_FALSE(ResponseEvidence().open(1));
    EXPECT_TRUE(ResponseEvidence().open(2));
    // What two edges of no bow say, four can outweigh that have one, and two cannot.
    ResponseEvidence evidence(bow(0.0, 0.3), bow(0.0, 0.3));
    EXPECT_FALSE(evidence.open(2));
    EXPECT_TRUE(evidence.open(4));
    for (int post = 0; post < 2; ++post) evidence += ResponseEvidence(bow(1.0, 0.0), bow(1.0, 0.0));
    EXPECT_EQ(evidence.response(), CameraResponse::srgb);
}

TEST(ResponseEvidence, DoesNotBelieveRowsThatContradictEachOther) {
    EXPECT_EQ(ResponseEvidence(bow(0.9, 5.0), bow(0.9, 5.0)).response(), CameraResponse::linear);
}

TEST(ResponseEvidence, OfManyPostsAddsUp) {
    const ResponseEvidence post(bow(0.9, 3.0), bow(0.9, 3.0));
    EXPECT_EQ(post.response(), CameraResponse::linear);
    ResponseEvidence sum;
    for (int i = 0; i < 4; ++i) sum += post;
    EXPECT_EQ(sum.response(), CameraResponse::srgb);
}

}  // namespace
}  // namespace goalmouth
