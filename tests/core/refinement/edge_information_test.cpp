#include "core/refinement/bound.h"
#include "tests/core/refinement/photographed_edge.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;

double radians(double degrees) {
    return degrees * pi / 180.0;
}

/// Edges across a patch of even height: the shift's errors of many fits.
std::vector<double> shift_errors(const EdgeLook& look, double angle, int tries, std::uint64_t seed,
                                 double& length) {
    // n points from the background to the post; an angle of 0 is an upright edge.
    const Vector2d normal(std::cos(angle), std::sin(angle));
    const bool steep = std::abs(normal.x()) > std::abs(normal.y());
    constexpr int along = 30;
    constexpr int across = 7;  // px to either side
    std::vector<Pair> pairs;
    const Vector2d middle(100.3, 100.4);
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; x += 2) {
            const Vector2d off = Vector2d(x + 0.5, y) - middle;
            if (std::abs(normal.dot(off)) > across) continue;
            const double place = steep ? y - 85 : x - 85 + 0.5;
            if (place < 0.0 || place >= along) continue;
            pairs.push_back({x, y, &look});
        }
    length = along / std::max(std::abs(normal.x()), std::abs(normal.y()));
    const Coverage profile(look.blur, normal);
    Random random(seed);
    std::vector<double> errors;
    for (int i = 0; i < tries; ++i) {
        const double shift = random.uniform(-1.0, 1.0);  // everywhere in a pair
        const auto covered_by = [&](const Eigen::VectorXd& s) -> Covered {
            return [&, s = s[0]](double x, double y) {
                return profile(normal.dot(Vector2d(x, y) - middle) - s);
            };
        };
        const Eigen::VectorXd truth = Eigen::VectorXd::Constant(1, shift);
        const auto values = photograph(pairs, covered_by(truth), random);
        const Eigen::VectorXd start = truth.array() + 0.2;
        errors.push_back(fit(pairs, values, covered_by, start, Eigen::VectorXd::Constant(1, 0.01))[0] -
                         shift);
    }
    return errors;
}

TEST(EdgeInformation, IsReachedByMaximumLikelihoodAtEveryAngle) {
    for (const double degrees : {1.5, 10.0, 20.0, 45.0, 90.0}) {
        SCOPED_TRACE(degrees);
        const EdgeLook look = yellow_before(grey);
        const double angle = radians(degrees);
        double length = 0.0;
        const auto errors = shift_errors(look, angle, 800, 7, length);
        expect_reached(errors,
                       1.0 / std::sqrt(length * edge_information(look, {std::cos(angle), std::sin(angle)})));
    }
}

TEST(EdgeInformation, HoldsForOtherNoiseBlurAndColours) {
    EdgeLook faint = yellow_before(0.5 * yellow + 0.2 * (grey - yellow), 4.0, 4.0);
    EdgeLook dark = yellow_before(carpet, 24.0, 4.0);  // a bright post's photon noise
    EdgeLook soft = yellow_before(carpet);
    soft.blur = 1.6;
    EdgeLook clean = yellow_before(grey, 0.5, 0.5);  // rounding counts
    for (const EdgeLook& look : {faint, dark, soft, clean}) {
        double length = 0.0;
        const double angle = radians(-7.0);
        const auto errors = shift_errors(look, angle, 800, 11, length);
        SCOPED_TRACE(&look - &faint);
        expect_reached(errors,
                       1.0 / std::sqrt(length * edge_information(look, {std::cos(angle), std::sin(angle)})));
    }
}

TEST(EdgeInformation, IsNoneWhereTheBackgroundIsThePostsColour) {
    const Vector2d across(1.0, 0.0);
    EXPECT_NEAR(edge_information(yellow_before(yellow), across), 0.0, 1e-12);
    EXPECT_NEAR(edge_information(yellow_before(0.4 * yellow), across), 0.0, 1e-12)
        << "a shadow is the post's colour too";
    EXPECT_GT(edge_information(yellow_before(grey), across), 1.0);
    EXPECT_NEAR(contrast_to_noise(yellow_before(0.4 * yellow)), 0.0, 1e-6);
}

TEST(EdgeInformation, DoesNotKnowHowBrightThePostIs) {
    const Vector2d across(0.6, 0.8);
    EdgeLook bright = yellow_before(grey);
    EdgeLook shaded = bright;
    shaded.post *= 0.3;
    EXPECT_NEAR(edge_information(shaded, across), edge_information(bright, across),
                1e-9 * edge_information(bright, across));
}

TEST(EdgeInformation, GrowsWithContrastAndFallsWithNoiseAndBlur) {
    const Vector2d level(0.0, 1.0);
    const double plain = edge_information(yellow_before(grey), level);
    // Without rounding, information goes with the inverse of the noise's variance.
    EXPECT_NEAR(edge_information(yellow_before(grey, 64.0, 64.0), level) / plain, 0.25, 0.01);
    EXPECT_NEAR(edge_information(yellow_before(0.5 * grey), level) / plain, 0.25, 1e-9);
    EdgeLook soft = yellow_before(grey);
    soft.blur = std::sqrt(4.0 * (0.85 * 0.85 + 1.0 / 12.0) - 1.0 / 12.0);
    EXPECT_NEAR(edge_information(soft, level) / plain, 0.5, 1e-9) << "as one over the profile's σ";
    EXPECT_GT(plain, edge_information(yellow_before(grey), {1.0, 0.0})) << "pairs blur upright edges";
}

}  // namespace
}  // namespace goalmouth
