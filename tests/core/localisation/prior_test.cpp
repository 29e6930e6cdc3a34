#include "core/localisation/prior.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

double weight(const Particles& particles) {
    return std::accumulate(particles.begin(), particles.end(), 0.0,
                           [](double s, const Particle& p) { return s + p.weight; });
}

TEST(Prior, StartPosesGetEqualSharesAndTheRestLiesInTheOwnHalf) {
    Random random(1);
    PriorParameters p;
    const Particles particles = draw_prior(Field{}, p, 400, random);
    ASSERT_EQ(particles.size(), 400U);
    EXPECT_NEAR(weight(particles), 1.0, 1e-12);
    int left = 0;
    int right = 0;
    for (const Particle& q : particles) {
        left += std::hypot(q.pose.x + 1.8, q.pose.y - 2.0) < 1.0 &&
                std::abs(wrap_angle(q.pose.theta + 1.5708)) < 1.0;
        right += std::hypot(q.pose.x + 1.8, q.pose.y + 2.0) < 1.0 &&
                 std::abs(wrap_angle(q.pose.theta - 1.5708)) < 1.0;
    }
    EXPECT_NEAR(left, 180, 6);
    EXPECT_NEAR(right, 180, 6);
}

TEST(Prior, OwnHalfAndField) {
    Random random(2);
    PriorParameters p;
    p.kind = "own_half";
    double highest = -10;
    for (const Particle& q : draw_prior(Field{}, p, 1000, random)) highest = std::max(highest, q.pose.x);
    EXPECT_LE(highest, 0.0);
    EXPECT_GT(highest, -0.1);
    p.kind = "field";
    for (const Particle& q : draw_prior(Field{}, p, 1000, random)) highest = std::max(highest, q.pose.x);
    EXPECT_LE(highest, 3.0);
    EXPECT_GT(highest, 2.9);
}

TEST(Prior, ListsOfUnequalLengthAreAMistake) {
    PriorParameters p;
    EXPECT_EQ(prior_problem(p), "");
    p.theta.pop_back();
    EXPECT_NE(prior_problem(p), "");
    p.kind = "field";
    EXPECT_EQ(prior_problem(p), "");
    p = {};
    p.x = p.y = p.theta = {};
    EXPECT_NE(prior_problem(p), "");
}

TEST(Prior, OneParticleIsAPrior) {
    Random random(3);
    EXPECT_EQ(draw_prior(Field{}, {}, 1, random).size(), 1U);
}

}  // namespace
}  // namespace goalmouth
