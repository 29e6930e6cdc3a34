#include "tools/evaluate/scored_overlay.h"

#include "tests/support/upright_post.h"

#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::post_at;
using test::truth_at;

cv::Scalar at(const cv::Mat& picture, int x, int y) {
    const auto& pixel = picture.at<cv::Vec3b>(y, x);
    return {static_cast<double>(pixel[0]), static_cast<double>(pixel[1]), static_cast<double>(pixel[2])};
}

/// How many pixels of a row between two columns have a colour.
int count(const cv::Mat& picture, const cv::Scalar& colour, int y, int from, int to) {
    int n = 0;
    for (int x = from; x < to; ++x)
        if (at(picture, x, y) == colour) ++n;
    return n;
}

cv::Mat drawn(const std::vector<ReferencePost>& truth, const std::vector<Post>& posts, int width = 640) {
    cv::Mat picture(400, width, CV_8UC3, cv::Scalar(30, 120, 40));
    draw_scored_posts(picture, truth, posts, match_posts(truth, posts, {}));
    return picture;
}

TEST(ScoredOverlay, DrawsEachPostInTheColourOfWhatBecameOfIt) {
    ReferencePost hidden = truth_at(400, 440);
    hidden.counts = false;
    const cv::Mat picture = drawn({truth_at(100, 140), truth_at(250, 290), hidden},
                                  {post_at(106, 146), post_at(402, 442), post_at(550, 590)});
    EXPECT_EQ(at(picture, 100, 200), scored_colour::found_truth);
    EXPECT_EQ(at(picture, 106, 200), scored_colour::right_post);
    EXPECT_EQ(at(picture, 250, 200), scored_colour::missed_truth);
    EXPECT_EQ(at(picture, 290, 200), scored_colour::missed_truth);
    EXPECT_EQ(at(picture, 402, 200), scored_colour::left_out) << "means a post that does not count";
    EXPECT_EQ(at(picture, 550, 200), scored_colour::wrong_post);
    EXPECT_EQ(at(picture, 570, 300), scored_colour::wrong_post) << "its foot";
    EXPECT_EQ(at(picture, 200, 200), cv::Scalar(30, 120, 40)) << "nothing between them";
    EXPECT_EQ(at(picture, 270, 200), cv::Scalar(30, 120, 40)) << "nor inside";
}

TEST(ScoredOverlay, HasASeamAndLinesThatCanBeSeenAtHalfTheSize) {
    const cv::Mat picture = drawn({}, {post_at(300, 360)});
    EXPECT_GE(count(picture, scored_colour::wrong_post, 200, 290, 310), 3);
    for (const int x : {298, 302})
        EXPECT_LT(at(picture, x, 200)[1], 80.0) << "darker than line and background beside it";
    EXPECT_GE(count(drawn({}, {post_at(300, 360)}, 1600), scored_colour::wrong_post, 200, 280, 320), 7)
        << "wider in a larger picture";
}

TEST(ScoredOverlay, DashesAPostThatDoesNotCount) {
    ReferencePost hidden = truth_at(400, 440);
    hidden.counts = false;
    const cv::Mat picture = drawn({hidden}, {});
    int grey = 0;
    for (int y = 105; y < 295; ++y)
        if (at(picture, 400, y) == scored_colour::left_out) ++grey;
    EXPECT_GT(grey, 60);
    EXPECT_LT(grey, 170) << "of 190: gaps, with the round ends of dashes in them";
}

TEST(ScoredOverlay, TakesOutlinesBesideThePicture) {
    const cv::Mat picture = drawn({truth_at(-1e9, 20)}, {post_at(630, 1e12)});
    EXPECT_EQ(at(picture, 630, 200), scored_colour::wrong_post);
}

}  // namespace
}  // namespace goalmouth
