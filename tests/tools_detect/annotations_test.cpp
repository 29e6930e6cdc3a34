#include "tests/tools_detect/annotations.h"

#include <gtest/gtest.h>

namespace goalmouth::test {
namespace {

Post detection(double left, double right, double lean = 0.0) {
    Post post;
    post.left_top = {left + lean, 100};
    post.left_base = {left, 300};
    post.right_top = {right + lean, 100};
    post.right_base = {right, 300};
    return post;
}

AnnotatedImage image() {
    AnnotatedImage one;
    one.posts.push_back({{200, 50}, {200, 250}, {220, 50}, {220, 250}, 20});
    return one;
}

void expect_score(const Score& s, int found, int missed, int wrong) {
    EXPECT_EQ(s.found, found);
    EXPECT_EQ(s.missed, missed);
    EXPECT_EQ(s.wrong, wrong);
}

TEST(Score, AllowsAQuarterOfTheWidth) {
    expect_score(score(image(), {detection(204.9, 224.9)}), 1, 0, 0);
    expect_score(score(image(), {detection(205.1, 220)}), 0, 1, 1);
    expect_score(score(image(), {detection(200, 225.1)}), 0, 1, 1);
}

TEST(Score, LooksAtTwoHeights) {
    // The annotated post's quarters lie at y = 100 and 200; both detections are right half-way between.
    expect_score(score(image(), {detection(188, 208, 16)}), 1, 0, 0);  // 4 px off at each
    expect_score(score(image(), {detection(182, 202, 24)}), 0, 1, 1);  // 6 px
}

TEST(Score, CountsOneDetectionForOnePost) {
    expect_score(score(image(), {detection(200, 220), detection(201, 221)}), 1, 0, 1);
    AnnotatedImage two = image();
    two.posts.push_back(two.posts[0]);
    expect_score(score(two, {detection(200, 220)}), 1, 1, 0);
}

TEST(Score, IgnoresWhatItIsToldTo) {
    AnnotatedImage one = image();
    one.ignore.emplace_back(Eigen::Vector2d(400, 0), Eigen::Vector2d(500, 480));
    expect_score(score(one, {detection(440, 460)}), 0, 1, 0);
    expect_score(score(one, {detection(540, 560)}), 0, 1, 1);
}

TEST(Score, OfAPictureWithoutPosts) {
    expect_score(score(AnnotatedImage{}, {}), 0, 0, 0);
    expect_score(score(AnnotatedImage{}, {detection(1, 20)}), 0, 0, 1);
}

}  // namespace
}  // namespace goalmouth::test
