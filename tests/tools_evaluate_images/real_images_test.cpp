#include "tests/support/data.h"
#include "tools/evaluate/images_report.h"

#include <cmath>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

// How many posts of the annotated real pictures are found, and how many that are none. The table a picture is
// judged with never saw it.
namespace goalmouth {
namespace {

ImageSetResult evaluated(const std::filesystem::path& data, const std::string& set,
                         bool without_labels = false) {
    ImagesResult result{"", "", {}, {}};
    result.options.folder = data;
    result.options.sets = {set};
    result.options.detectors = {"ransac", "tuned"};
    result.options.without_labels = without_labels;
    result.options.jobs = 2;
    result.sets = evaluate_images(result.options);
    std::printf("%s", images_text(result).c_str());
    return result.sets.at(0);
}

void expect_at_least(const ImageScore& score, double recall, double precision) {
    EXPECT_GE(score.recall(), recall);
    EXPECT_GE(score.precision(), precision);
}

// Bounds: what was measured, less one post or one false one; on the NAO's pictures the tuned settings have
// nothing to spare.

TEST(RealImages, DarwinOp2014) {
    GOALMOUTH_NEEDS_DATA(data);
    const ImageSetResult set = evaluated(data, "darwin_op_2014");
    EXPECT_EQ(set.score("ransac").posts, 29);
    EXPECT_EQ(set.score("ransac").negatives, 15);
    expect_at_least(set.score("ransac"), 0.86, 0.86);
    expect_at_least(set.score("tuned"), 0.93, 0.93);
}

TEST(RealImages, NaoUva2013) {
    GOALMOUTH_NEEDS_DATA(data);
    const ImageSetResult set = evaluated(data, "nao_uva_2013");
    EXPECT_EQ(set.score("ransac").posts, 18);
    EXPECT_EQ(set.score("ransac").negatives, 12);
    expect_at_least(set.score("ransac"), 0.88, 0.94);
    expect_at_least(set.score("tuned"), 0.94, 0.94);
}

// Tables that nobody marked anything for.

TEST(RealImages, DarwinOp2014WithoutLabels) {
    GOALMOUTH_NEEDS_DATA(data);
    const ImageSetResult set = evaluated(data, "darwin_op_2014", true);
    expect_at_least(set.score("ransac"), 0.86, 0.86);
    expect_at_least(set.score("tuned"), 0.93, 0.93);
    EXPECT_EQ(set.score("ransac").wrong_on_negatives, 0);
}

TEST(RealImages, NaoUva2013WithoutLabels) {
    GOALMOUTH_NEEDS_DATA(data);
    const ImageSetResult set = evaluated(data, "nao_uva_2013", true);
    expect_at_least(set.score("ransac"), 0.88, 0.94);
    expect_at_least(set.score("tuned"), 0.88, 0.88);
    EXPECT_EQ(set.score("ransac").wrong_on_negatives, 0);
}

// Without any table: the graph is given none, and none is learnt.
TEST(RealImages, ByEdges) {
    GOALMOUTH_NEEDS_DATA(data);
    ImagesResult result{"", "", {}, {}};
    result.options.folder = data;
    result.options.sets = {"darwin_op_2014", "nao_uva_2013"};
    result.options.detectors = {"edges"};
    result.options.jobs = 2;
    result.sets = evaluate_images(result.options);
    std::printf("%s", images_text(result).c_str());
    int wrong_on_negatives = 0;
    for (const ImageSetResult& set : result.sets) {
        expect_at_least(set.score("edges"), 0.75, 0.75);
        wrong_on_negatives += set.score("edges").wrong_on_negatives;
    }
    EXPECT_LE(wrong_on_negatives, 3);
}

const DistanceGroup* group_of(const std::vector<DistanceGroup>& groups, const std::string& detector,
                              const std::string& of) {
    for (const DistanceGroup& group : groups)
        if (group.detector == detector && group.of == of) return &group;
    return nullptr;
}

// A refined post's distance is right to what the robot's place and the post's diameter allow; refinement's
// edges lie where a person's lie, to that person's σ of 1 px.
TEST(RealImages, DistancesOfNaoUva2013) {
    GOALMOUTH_NEEDS_DATA(data);
    ImagesResult result{"", "", {}, {}};
    result.options.folder = data;
    result.options.sets = {"nao_uva_2013"};
    result.options.detectors = {"ransac", "refined"};
    result.options.poses = {
        {"nao_uva_2013", "{}_{x_cm}_{y_cm}_{heading_deg}_{head_pitch_rad}_{head_yaw_rad}_{}"}};
    result.options.jobs = 2;
    result.sets = evaluate_images(result.options);
    std::printf("%s", images_text(result).c_str());
    const ImageSetResult& set = result.sets.at(0);

    const PlacementSummary placed = placement_summary(set.of("ransac"));
    EXPECT_EQ(placed.posts, 18U);
    EXPECT_EQ(placed.unplaced, 0U);
    EXPECT_LT(placed.direction_rms, placement_sigma);

    const std::vector<DistanceGroup> groups_of_set = set.distances(result.options.detectors);
    const DistanceGroup* ransac = group_of(groups_of_set, "ransac", "all");
    const DistanceGroup* refined = group_of(groups_of_set, "refined", "refined");
    const DistanceGroup* outlines = group_of(groups_of_set, "", "all");
    ASSERT_TRUE(ransac && refined && outlines);
    const auto of_ransac = distance_summary(ransac->samples);
    const auto of_refined = distance_summary(refined->samples);
    const auto of_outlines = distance_summary(outlines->samples);
    ASSERT_TRUE(of_ransac && of_refined && of_outlines);
    EXPECT_LT(of_ransac->relative_rms, 0.13);
    EXPECT_GE(of_refined->posts, 6U);
    EXPECT_LT(of_refined->relative_rms, 0.03);
    EXPECT_LT(std::abs(of_refined->errors.bias), 0.08);
    EXPECT_LT(of_refined->relative_rms, 0.5 * of_ransac->relative_rms);
    EXPECT_LT(of_outlines->relative_rms, 0.05);

    for (const MeasuredGroup& group : groups(set.measured("refined"))) {
        if (group.name != "refined") continue;
        const EdgeSummary edges = edge_summary(group.posts);
        ASSERT_TRUE(edges.left && edges.right && edges.width && edges.annotation_sigma);
        EXPECT_LT(edges.left->rmse, *edges.annotation_sigma);
        EXPECT_LT(edges.right->rmse, *edges.annotation_sigma);
        EXPECT_LT(edges.width->rmse, *edges.annotation_sigma);
    }
}

}  // namespace
}  // namespace goalmouth
