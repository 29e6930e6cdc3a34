#include "core/detection/histogram.h"

#include "core/detection/histogram_detector.h"
#include "core/random/random.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

CandidateSegment row(int y, int start, int end) {
    return {Orientation::horizontal, y, start, end};
}
CandidateSegment column(int x, int start, int end) {
    return {Orientation::vertical, x, start, end};
}

std::vector<std::pair<std::size_t, std::size_t>> groups(const std::vector<double>& counts) {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    for (const auto& g : group_peaks(counts, 10.0)) found.emplace_back(g.first, g.last);
    return found;
}
using Groups = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(Histogram, SumsLengthsOfBothOrientationsByTheirCentres) {
    const Histogram h =
        build_histogram({row(5, 0, 9), column(31, 10, 29), row(6, 30, 35), row(7, 639, 639)}, 640, 20);
    EXPECT_DOUBLE_EQ(h.bin_width, 32.0);
    EXPECT_DOUBLE_EQ(h.counts[0], 10.0 + 20.0);
    EXPECT_DOUBLE_EQ(h.counts[1], 6.0);  // centre 32.5
    EXPECT_DOUBLE_EQ(h.counts[19], 1.0);
    EXPECT_DOUBLE_EQ(std::accumulate(h.counts.begin(), h.counts.end(), 0.0), 37.0);
}

TEST(Histogram, BinsAreHalfOpenAndCoverTheImage) {
    const Histogram h = build_histogram({}, 100, 8);
    EXPECT_EQ(h.bin(0), 0U);
    EXPECT_EQ(h.bin(12.49), 0U);
    EXPECT_EQ(h.bin(12.5), 1U);
    EXPECT_EQ(h.bin(99), 7U);
}

TEST(HistogramGrouping, MergesAdjacentPeaks) {
    EXPECT_EQ(groups({0, 20, 30, 0, 10, 9, 50}), (Groups{{1, 2}, {4, 4}, {6, 6}}));
    EXPECT_EQ(groups({20, 20, 20}), (Groups{{0, 2}}));
    EXPECT_EQ(groups({0, 0, 0}), Groups{});
    EXPECT_EQ(groups({}), Groups{});
}

TEST(HistogramGrouping, ReachesTheLastBin) {
    EXPECT_EQ(groups({0, 0, 20}), (Groups{{2, 2}}));
    EXPECT_EQ(groups({0, 20, 20}), (Groups{{1, 2}}));
    EXPECT_EQ(groups({20}), (Groups{{0, 0}}));
}

TEST(HistogramGrouping, PartitionsThePeaksOfRandomHistograms) {
    Random random(4);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<double> counts(1 + random.index(20));
        for (auto& c : counts) c = random.uniform(0, 20);
        std::vector<int> covered(counts.size(), 0);
        for (const auto& g : group_peaks(counts, 10.0)) {
            for (std::size_t i = g.first; i <= g.last; ++i) ++covered[i];
            EXPECT_TRUE(g.first == 0 || counts[g.first - 1] < 10.0);
            EXPECT_TRUE(g.last + 1 == counts.size() || counts[g.last + 1] < 10.0);
        }
        for (std::size_t i = 0; i < counts.size(); ++i) EXPECT_EQ(covered[i], counts[i] >= 10.0 ? 1 : 0);
    }
}

TEST(HistogramOutsized, LeavesOutTheCrossbar) {
    std::vector<CandidateSegment> segments;
    for (int y = 0; y < 50; ++y) segments.push_back(row(y, 100, 119));
    segments.push_back(row(60, 100, 400));
    const auto kept = without_outsized(segments, 3.0);
    EXPECT_EQ(kept.size(), 50U);
    EXPECT_EQ(without_outsized(segments, 0.0).size(), 51U);
}

TEST(HistogramOutsized, KeepsSegmentsThatAreAllAlike) {
    EXPECT_EQ(without_outsized(std::vector<CandidateSegment>(20, row(3, 10, 29)), 3.0).size(), 20U);
    EXPECT_TRUE(without_outsized({}, 3.0).empty());
}

Candidates upright_post(int left, int right, int top, int bottom) {
    Candidates c;
    c.width = 640;
    c.height = 480;
    for (int y = top; y <= bottom; y += 4) c.segments.push_back(row(y, left, right));
    for (int x = left; x <= right; x += 4) c.segments.push_back(column(x, top, bottom));
    return c;
}

TEST(HistogramDetector, BoxesAnUprightPost) {
    const Intrinsics camera;
    const auto posts = detect_posts_by_histogram(upright_post(310, 329, 100, 280), camera, 0.1, {});
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_EQ(posts[0].left_top, Eigen::Vector2d(309.5, 99.5));
    EXPECT_EQ(posts[0].right_base, Eigen::Vector2d(329.5, 280.5));
    EXPECT_NEAR(posts[0].width_px, 20.0, 1e-9);
    EXPECT_NEAR(posts[0].distance_m, 0.1 * camera.fx / 20.0, 1e-9);
    EXPECT_NEAR(posts[0].bearing_rad, 0.0, 1e-3);
}

TEST(HistogramDetector, WidensALeaningPostAsThePaperSays) {
    Candidates c;
    c.width = 640;
    c.height = 480;
    for (int y = 100; y <= 300; y += 4)
        c.segments.push_back(row(y, 310 + (y - 100) / 4, 329 + (y - 100) / 4));
    HistogramParameters parameters;
    parameters.peak_threshold = 10.0;
    const auto posts = detect_posts_by_histogram(c, {}, 0.1, parameters);
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_NEAR(posts[0].width_px, 70.0, 1e-9);
}

TEST(HistogramDetector, SaysThatThePostIsCut) {
    const auto posts = detect_posts_by_histogram(upright_post(0, 19, 0, 280), {}, 0.1, {});
    ASSERT_EQ(posts.size(), 1U);
    EXPECT_TRUE(posts[0].has(post_flag::left_edge_missing));
    EXPECT_TRUE(posts[0].has(post_flag::cut_left));
    EXPECT_TRUE(posts[0].has(post_flag::cut_top));
    EXPECT_FALSE(posts[0].has(post_flag::cut_right));
    EXPECT_TRUE(posts[0].has(post_flag::no_distance));
    EXPECT_EQ(posts[0].distance_m, 0.0);
}

TEST(HistogramDetector, OfNothingIsNothing) {
    EXPECT_TRUE(detect_posts_by_histogram({}, {}, 0.1, {}).empty());
}

}  // namespace
}  // namespace goalmouth
