#include "tests/support/data.h"
#include "tools/evaluate/images_report.h"

#include <cstdio>
#include <string>

#include <gtest/gtest.h>

// How many posts of the annotated real pictures are found, and how many that are none. The table a picture is
// judged with never saw it.
namespace goalmouth {
namespace {

ImageSetResult evaluated(const std::filesystem::path& data, const std::string& set) {
    ImagesResult result{"", "", {}, {}};
    result.options.folder = data;
    result.options.sets = {set};
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

}  // namespace
}  // namespace goalmouth
