#include "core/detection/pairing.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr int width = 640;
constexpr int height = 480;
constexpr double gamma_times_diameter = 55.4;

EdgeLine edge(const Eigen::Vector2d& upper, const Eigen::Vector2d& lower, int support = 40) {
    return {{*line_through(upper, lower), upper, lower}, support, 0.3};
}

Candidates frame() {
    Candidates candidates;
    candidates.width = width;
    candidates.height = height;
    return candidates;
}

std::size_t pairs(const EdgeLine& left, const EdgeLine& right, const PairingParameters& parameters = {}) {
    return pair_edges({left}, {right}, frame(), gamma_times_diameter, parameters).size();
}

PairMeasures measures(const EdgeLine& left, const EdgeLine& right) {
    return compare_edges(left, right, width, height, 0.2);
}

const EdgeLine left_edge = edge({300, 100}, {300, 300});

TEST(Pairing, TakesTheTwoEdgesOfAPost) {
    const EdgeLine right = edge({320, 100}, {320, 300});
    EXPECT_EQ(pairs(left_edge, right), 1U);
    const PairMeasures m = measures(left_edge, right);
    EXPECT_NEAR(m.angle, 0.0, 1e-12);
    EXPECT_NEAR(m.width, 20.0, 1e-9);
    EXPECT_NEAR(m.length, 200.0, 1e-9);
    EXPECT_NEAR(m.endpoint_distance, 20.0, 1e-9);
    EXPECT_TRUE(m.similar());
}

TEST(Pairing, BoundsFollowThePermissiveness) {
    const PairMeasures m = measures(left_edge, edge({320, 100}, {320, 350}, 50));
    EXPECT_NEAR(m.angle_bound, 0.2 * std::numbers::pi / 2, 1e-12);
    EXPECT_NEAR(m.length_bound, 0.2 * 250, 1e-9);
    EXPECT_NEAR(m.endpoint_bound, 0.2 * 800, 1e-9);
    EXPECT_NEAR(m.support_bound, 0.2 * 50, 1e-12);
}

TEST(Pairing, RejectsUnlikeAngles) {
    // Both about their middles, so that nothing but the angle differs; the bound is 18°.
    const auto turned = [](double degrees) {
        const double a = degrees * std::numbers::pi / 180;
        const Eigen::Vector2d half(100 * std::sin(a), 100 * std::cos(a));
        return edge(Eigen::Vector2d(340, 200) - half, Eigen::Vector2d(340, 200) + half);
    };
    EXPECT_EQ(pairs(left_edge, turned(17)), 1U);
    EXPECT_EQ(pairs(left_edge, turned(19)), 0U);
    EXPECT_EQ(pairs(left_edge, turned(-17)), 1U);
    EXPECT_EQ(pairs(left_edge, turned(-19)), 0U);
}

TEST(Pairing, RejectsUnlikeLengths) {
    EXPECT_EQ(pairs(left_edge, edge({320, 135}, {320, 300})), 1U);
    EXPECT_EQ(pairs(left_edge, edge({320, 145}, {320, 300})), 0U);
}

TEST(Pairing, RejectsEdgesFarFromEachOther) {
    PairingParameters parameters;
    parameters.nearest = 0.0;
    parameters.least_aspect = 0.0;
    EXPECT_EQ(pairs(left_edge, edge({459, 100}, {459, 300}), parameters), 1U);
    EXPECT_EQ(pairs(left_edge, edge({461, 100}, {461, 300}), parameters), 0U);
}

TEST(Pairing, RejectsUnlikeSupport) {
    EXPECT_EQ(pairs(left_edge, edge({320, 100}, {320, 300}, 33)), 1U);
    EXPECT_EQ(pairs(left_edge, edge({320, 100}, {320, 300}, 32)), 0U);
    EXPECT_EQ(pairs(left_edge, edge({320, 100}, {320, 300}, 49)), 1U);
    EXPECT_EQ(pairs(left_edge, edge({320, 100}, {320, 300}, 50)), 0U);
}

TEST(Pairing, RejectsALeftEdgeRightOfItsRightEdgeUnlessTold) {
    const EdgeLine right = edge({280, 100}, {280, 300});
    EXPECT_EQ(pairs(left_edge, right), 0U);
    PairingParameters parameters;
    parameters.left_of = false;
    EXPECT_EQ(pairs(left_edge, right, parameters), 1U);
}

TEST(Pairing, RejectsSquatPostsUnlessTold) {
    const EdgeLine right = edge({435, 100}, {435, 300});  // 200 / 135 = 1.48
    PairingParameters parameters;
    EXPECT_EQ(pairs(left_edge, right, parameters), 0U);
    parameters.least_aspect = 1.4;
    EXPECT_EQ(pairs(left_edge, right, parameters), 1U);
    parameters.least_aspect = 0.0;
    EXPECT_EQ(pairs(left_edge, right, parameters), 1U);
}

TEST(Pairing, RejectsImplausibleDistancesUnlessTold) {
    const EdgeLine thin = edge({304, 100}, {304, 300});  // 13.9 m away
    PairingParameters parameters;
    EXPECT_EQ(pairs(left_edge, thin, parameters), 0U);
    parameters.farthest = 14.0;
    EXPECT_EQ(pairs(left_edge, thin, parameters), 1U);
    parameters.nearest = 13.9;
    EXPECT_EQ(pairs(left_edge, thin, parameters), 0U);
    parameters.farthest = 0.0;
    EXPECT_EQ(pairs(left_edge, thin, parameters), 1U);
}

TEST(Pairing, TakesACrossbarForAPostUnlessTold) {
    const EdgeLine upper = edge({400, 60}, {200, 100});
    const EdgeLine lower = edge({400, 90}, {200, 130});
    PairingParameters parameters;
    parameters.left_of = false;
    EXPECT_EQ(pairs(upper, lower, parameters), 1U);
    parameters.largest_lean = 0.6;
    EXPECT_EQ(pairs(upper, lower, parameters), 0U);
    EXPECT_EQ(pairs(edge({300, 100}, {360, 300}), edge({320, 100}, {380, 300}), parameters), 1U)
        << "17 degrees is a tilt";
}

TEST(Pairing, WithoutPermissivenessTakesNothing) {
    PairingParameters parameters;
    parameters.permissiveness = 0.0;
    EXPECT_EQ(pairs(left_edge, edge({320, 100}, {320, 300}), parameters), 0U);
}

TEST(Pairing, UsesEachLineOnceAndPrefersTheMostAlike) {
    const std::vector<EdgeLine> left{edge({300, 100}, {300, 300}), edge({500, 100}, {500, 300})};
    const std::vector<EdgeLine> right{edge({325, 110}, {325, 300}), edge({520, 100}, {520, 300}),
                                      edge({320, 100}, {320, 300})};
    const auto found = pair_edges(left, right, frame(), gamma_times_diameter, {});
    ASSERT_EQ(found.size(), 2U);
    for (const auto& [l, r] : found) EXPECT_EQ(r, l == 0 ? 2U : 1U);
}

TEST(Pairing, ComparesAnEdgeThatTheImageCutsOverTheRowsItShares) {
    // The post leaves the image at the left: its left edge ends at x = 0, half-way up.
    const EdgeLine cut = edge({0.5, 200}, {30, 300}, 25);
    const EdgeLine whole = edge({-59 + 86, 100}, {60, 300}, 50);
    PairingParameters parameters;
    EXPECT_EQ(pairs(cut, whole, parameters), 0U);
    parameters.cut_margin = 6.0;
    EXPECT_EQ(pairs(cut, whole, parameters), 1U);
    // Inside the image the same two are no post.
    const EdgeLine inner = edge({100.5, 200}, {130, 300}, 25);
    const EdgeLine inner_whole = edge({127, 100}, {160, 300}, 50);
    EXPECT_EQ(pairs(inner, inner_whole, parameters), 0U);
}

TEST(Pairing, RejectsPostsWithALongHoleWhereTold) {
    const EdgeLine right = edge({320, 100}, {320, 300});
    Candidates candidates = frame();
    for (int y = 100; y <= 300; y += 4) {
        if (y < 150 || y > 230) candidates.segments.push_back({Orientation::horizontal, y, 300, 319});
    }
    EXPECT_NEAR(largest_hole(left_edge.segment, right.segment, candidates), (232.0 - 148.0) / 200.0, 1e-9);
    PairingParameters parameters;
    const auto accepted = [&] {
        return pair_edges({left_edge}, {right}, candidates, gamma_times_diameter, parameters).size();
    };
    EXPECT_EQ(accepted(), 1U);
    parameters.largest_hole = 0.43;
    EXPECT_EQ(accepted(), 1U);
    parameters.largest_hole = 0.41;
    EXPECT_EQ(accepted(), 0U);
    EXPECT_NEAR(largest_hole(left_edge.segment, right.segment, frame()), 1.0, 1e-12);
}

TEST(Pairing, OfNoLinesIsNothing) {
    EXPECT_TRUE(pair_edges({}, {left_edge}, frame(), gamma_times_diameter, {}).empty());
    EXPECT_TRUE(pair_edges({left_edge}, {}, frame(), gamma_times_diameter, {}).empty());
}

TEST(WidthAcross, IsTheSameForEveryLean) {
    for (int degrees = -80; degrees <= 80; degrees += 5) {
        const double a = degrees * std::numbers::pi / 180;
        const Eigen::Vector2d along(std::sin(a), std::cos(a));
        const Eigen::Vector2d across(std::cos(a), -std::sin(a));
        const Eigen::Vector2d c(320, 240);
        // Ends of different lengths: the width is across the axis, not from end to end.
        const EdgeLine l = edge(c - 10 * across - 100 * along, c - 10 * across + 90 * along);
        const EdgeLine r = edge(c + 10 * across - 80 * along, c + 10 * across + 100 * along);
        EXPECT_NEAR(width_across(l.segment, r.segment), 20.0, 1e-9) << degrees;
        EXPECT_NEAR(width_across(r.segment, l.segment), -20.0, 1e-9) << degrees;
    }
}

TEST(WidthAcross, OfATaperedPostIsThatOfItsMiddle) {
    const EdgeLine l = edge({300, 100}, {295, 300});
    const EdgeLine r = edge({320, 100}, {325, 300});
    EXPECT_NEAR(width_across(l.segment, r.segment), 25.0, 1e-9);
}

}  // namespace
}  // namespace goalmouth
