// What refinement is timed against measures the same thing.

#include "tests/bench/full_fit.h"

#include "core/imaging/colour_table_file.h"
#include "core/process/paths.h"
#include "tests/bench/refinement_rows.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth::bench {
namespace {

FrameSet frames_of(const char* scene, ImageSize size, int frames) {
    FrameOptions options;
    options.size = size;
    options.frames = frames;
    options.scene = scene;
    return render_frames(options);
}

std::vector<FoundPost> posts_in(const FrameSet& frames) {
    return found_posts(frames, load_colour_table(config_folder() / "colours/simulator.gmct"), 1);
}

/// |difference| of the distances that both find, in sigmas; in order.
std::vector<double> disagreements(const FrameSet& frames, const std::vector<FoundPost>& posts) {
    PostRefiner refiner(RefinementParameters{}, frames.field);
    std::vector<double> result;
    for (const FoundPost& found : posts)
        if (const auto each = measure_both(frames, found, refiner).disagreement()) result.push_back(*each);
    std::sort(result.begin(), result.end());
    return result;
}

/// One frame at each distance and tilt, where nothing but noise and shading disturbs.
void expect_agreement(ImageSize size) {
    const FrameSet frames = frames_of("lit", size, 18);
    const auto posts = posts_in(frames);
    ASSERT_GE(posts.size(), 18U);
    const auto found = disagreements(frames, posts);
    EXPECT_GE(found.size(), posts.size() * 9 / 10);
    ASSERT_FALSE(found.empty());
    EXPECT_LT(found[found.size() / 2], 1.0);
    EXPECT_LT(found.back(), 4.0);
}

TEST(FullFit, LandsWhereTheRefinerDoesAt640By480) {
    expect_agreement({640, 480});
}

TEST(FullFit, LandsWhereTheRefinerDoesAt1600By1200) {
    expect_agreement({1600, 1200});
}

TEST(FullFit, LandsThereForMostPostsOfTheFramesThatAreTimed) {
    // Compression, motion and clutter: it gates no rows, so not for all.
    const FrameSet frames = frames_of("match", {640, 480}, 36);
    const auto found = disagreements(frames, posts_in(frames));
    ASSERT_GE(found.size(), 5U);
    EXPECT_LT(found[found.size() / 2], 3.0);
}

TEST(FullFit, OfAPostWithoutAnEdgeIsNothing) {
    const FrameSet frames = frames_of("lit", {320, 240}, 1);
    const auto posts = posts_in(frames);
    ASSERT_FALSE(posts.empty());
    Post post = posts[0].post;
    ASSERT_TRUE(
        fit_all_pixels(frames.view(0), frames.camera, post, frames.field.post_diameter, std::nullopt));
    post.flags |= post_flag::left_edge_missing;
    EXPECT_FALSE(
        fit_all_pixels(frames.view(0), frames.camera, post, frames.field.post_diameter, std::nullopt));
    post = posts[0].post;
    post.left_base = post.left_top;
    EXPECT_FALSE(
        fit_all_pixels(frames.view(0), frames.camera, post, frames.field.post_diameter, std::nullopt));
    post = posts[0].post;
    std::swap(post.left_top, post.right_top);
    std::swap(post.left_base, post.right_base);
    EXPECT_FALSE(
        fit_all_pixels(frames.view(0), frames.camera, post, frames.field.post_diameter, std::nullopt));
}

TEST(FoundPosts, LieOnTrueOnesAndComeAgainInEveryCopyOfAFrame) {
    const FrameSet frames = frames_of("match", {320, 240}, 40);
    ASSERT_EQ(frames.different, 36U);
    const auto posts = posts_in(frames);
    ASSERT_FALSE(posts.empty());
    std::size_t copies = 0;
    for (const FoundPost& found : posts) {
        ASSERT_LT(found.frame, 40U);
        const auto& known = frames.posts[found.frame % frames.different];
        EXPECT_TRUE(std::any_of(known.begin(), known.end(), [&](const ReferencePost& post) {
            const double width = (post.right_top - post.left_top).norm();
            return std::abs(
                       0.5 *
                       (post.left_top + post.left_base - found.post.left_top - found.post.left_base).x()) <
                   0.5 * width;
        }));
        if (found.frame < frames.different) continue;
        ++copies;
        EXPECT_TRUE(std::any_of(posts.begin(), posts.end(), [&](const FoundPost& other) {
            return other.frame == found.frame - frames.different &&
                   other.post.left_top == found.post.left_top;
        }));
    }
    EXPECT_GT(copies, 0U);
}

}  // namespace
}  // namespace goalmouth::bench
