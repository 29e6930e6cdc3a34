#include "core/localisation/resampling.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

std::vector<double> random_weights(std::size_t count, Random& random) {
    std::vector<double> weights(count);
    double sum = 0.0;
    for (double& w : weights) {
        w = random.uniform() < 0.3 ? 0.0 : std::pow(random.uniform(), 4);
        sum += w;
    }
    if (sum == 0.0) weights.back() = sum = 1.0;
    for (double& w : weights) w /= sum;
    return weights;
}

TEST(SystematicResampling, EachIndexComesItsShareRoundedDownOrUp) {
    Random random(1);
    for (int trial = 0; trial < 500; ++trial) {
        const auto weights = random_weights(1 + random.index(60), random);
        const std::size_t count = 1 + random.index(300);
        const auto chosen = systematic_resample(weights, count, random);
        ASSERT_EQ(chosen.size(), count);
        ASSERT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
        for (std::size_t j = 0; j < weights.size(); ++j) {
            const auto times = static_cast<double>(std::count(chosen.begin(), chosen.end(), j));
            const double share = static_cast<double>(count) * weights[j];
            ASSERT_GE(times, std::floor(share - 1e-9));
            ASSERT_LE(times, std::ceil(share + 1e-9));
        }
    }
}

TEST(SystematicResampling, IsUnbiased) {
    Random random(2);
    const std::vector<double> weights = {0.013, 0.4, 0.0, 0.107, 0.23, 0.25};
    std::vector<double> times(weights.size(), 0.0);
    const int trials = 20000;
    for (int i = 0; i < trials; ++i) {
        for (const std::size_t j : systematic_resample(weights, 7, random)) times[j] += 1.0;
    }
    for (std::size_t j = 0; j < weights.size(); ++j)
        EXPECT_NEAR(times[j] / (7.0 * trials), weights[j], 0.002);
    EXPECT_EQ(times[2], 0.0) << "no weight, never chosen";
}

TEST(SystematicResampling, WeightsNeedNotSumToOne) {
    Random a(3);
    Random b(3);
    EXPECT_EQ(systematic_resample({1, 2, 3, 4}, 50, a), systematic_resample({0.1, 0.2, 0.3, 0.4}, 50, b));
}

TEST(SystematicResampling, OneParticleAndNoParticle) {
    Random random(4);
    EXPECT_EQ(systematic_resample({1.0}, 3, random), (std::vector<std::size_t>{0, 0, 0}));
    EXPECT_TRUE(systematic_resample({}, 3, random).empty());
    EXPECT_TRUE(systematic_resample({1.0}, 0, random).empty());
}

TEST(SystematicResampling, NothingWithoutWeightIsChosenAtEitherEnd) {
    Random random(5);
    for (int i = 0; i < 1000; ++i) {
        for (const std::size_t j : systematic_resample({0.0, 0.0, 1e-300, 0.0}, 5, random)) ASSERT_EQ(j, 2U);
    }
}

TEST(EffectiveSampleSize, IsTheNumberOfEqualWeights) {
    Particles particles(8);
    for (auto& p : particles) p.weight = 1.0 / 8;
    EXPECT_NEAR(effective_sample_size(particles), 8.0, 1e-12);
    for (auto& p : particles) p.weight = 0.0;
    particles[3].weight = 1.0;
    EXPECT_NEAR(effective_sample_size(particles), 1.0, 1e-12);
    particles[3].weight = particles[4].weight = 0.5;
    EXPECT_NEAR(effective_sample_size(particles), 2.0, 1e-12);
    EXPECT_EQ(effective_sample_size({}), 0.0);
}

}  // namespace
}  // namespace goalmouth
