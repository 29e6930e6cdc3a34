#include "core/messaging/validation.h"

#include "tests/core/messaging/breakages.h"
#include "tests/support/example_messages.h"


#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

TEST(Validation, AcceptsAnExampleOfEachType) {
    for_each_example(
        [](const auto& message) { EXPECT_EQ(problem(message), std::nullopt) << message.getTypeName(); });
}

TEST(Validation, AcceptsEmptyAnswers) {
    auto border = example_border();
    border.num_hull = border.num_points = 0;
    border.hull_x.clear(), border.hull_y.clear(), border.point_x.clear(), border.point_y.clear();
    EXPECT_EQ(problem(border), std::nullopt);
    auto posts = example_posts();
    posts.num_posts = 0;
    posts.posts.clear();
    EXPECT_EQ(problem(posts), std::nullopt);
    auto candidates = candidates_t{};
    candidates.intrinsics = example_intrinsics();
    EXPECT_EQ(problem(candidates), std::nullopt);
    auto segments = segments_t{};
    segments.intrinsics = example_intrinsics();
    EXPECT_EQ(problem(segments), std::nullopt);
}

}  // namespace
}  // namespace goalmouth
