#include "core/localisation/belief.h"

#include "core/random/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

void add_blob(Particles& particles, const Pose2& at, double sigma, double heading_sigma, int count,
              Random& random) {
    for (int i = 0; i < count; ++i) {
        particles.push_back({{at.x + sigma * random.normal(), at.y + sigma * random.normal(),
                              wrap_angle(at.theta + heading_sigma * random.normal())},
                             1.0});
    }
}

void normalise(Particles& particles) {
    for (Particle& p : particles) p.weight = 1.0 / static_cast<double>(particles.size());
}

TEST(Summary, HeadingIsAveragedOnTheCircle) {
    Particles particles = {{{0, 0, 3.1}, 0.5}, {{2, 4, -3.1}, 0.5}};
    const PoseHypothesis h = summarise(particles);
    EXPECT_NEAR(std::abs(h.pose.theta), std::numbers::pi, 1e-9);
    EXPECT_NEAR(h.pose.x, 1.0, 1e-12);
    EXPECT_NEAR(h.pose.y, 2.0, 1e-12);
    EXPECT_NEAR(std::sqrt(h.covariance(2, 2)), std::numbers::pi - 3.1, 0.01);
    EXPECT_NEAR(h.covariance(0, 1), 2.0, 1e-9);
}

TEST(Summary, CovarianceIsPositiveDefiniteForAnyParticles) {
    Random random(1);
    for (int trial = 0; trial < 500; ++trial) {
        Particles particles;
        const std::uint32_t n = 1 + random.index(5);
        for (std::uint32_t i = 0; i < n; ++i) {
            particles.push_back({{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-4, 4)},
                                 random.index(3) == 0 ? 0.0 : random.uniform()});
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(summarise(particles).covariance);
        ASSERT_GT(eigen.eigenvalues().minCoeff(), 0.0);
    }
}

TEST(Clusters, FindsSeparateBlobsTheHeaviestFirst) {
    Random random(2);
    Particles particles;
    add_blob(particles, {-2.0, 1.0, 0.3}, 0.12, 0.1, 120, random);
    add_blob(particles, {2.0, -1.0, 0.3 - std::numbers::pi}, 0.12, 0.1, 240, random);
    add_blob(particles, {-2.0, 1.0, 2.0}, 0.12, 0.1, 40, random);  // same place, another heading
    normalise(particles);
    const auto h = cluster(particles, {});
    ASSERT_EQ(h.size(), 3U);
    EXPECT_NEAR(h[0].weight, 0.6, 0.03);
    EXPECT_NEAR(h[1].weight, 0.3, 0.03);
    EXPECT_NEAR(h[2].weight, 0.1, 0.03);
    EXPECT_NEAR(h[0].pose.x, 2.0, 0.05);
    EXPECT_NEAR(h[1].pose.theta, 0.3, 0.05);
    EXPECT_NEAR(std::sqrt(h[0].covariance(0, 0)), 0.12, 0.03);
}

TEST(Clusters, HeadingsAtTheSeamOfTheCircleAreOneCluster) {
    Random random(3);
    Particles particles;
    add_blob(particles, {0.25, 0.25, std::numbers::pi}, 0.05, 0.2, 300, random);
    normalise(particles);
    const auto h = cluster(particles, {});
    ASSERT_EQ(h.size(), 1U);
    EXPECT_NEAR(std::abs(h[0].pose.theta), std::numbers::pi, 0.05);
}

TEST(Clusters, OrderOfParticlesDoesNotMatter) {
    Random random(4);
    Particles particles;
    add_blob(particles, {-2.0, 1.0, 0.3}, 0.3, 0.3, 150, random);
    add_blob(particles, {1.0, -1.0, 2.5}, 0.4, 0.4, 150, random);
    normalise(particles);
    const auto want = cluster(particles, {});
    for (int trial = 0; trial < 20; ++trial) {
        for (std::size_t i = particles.size() - 1; i > 0; --i) {
            std::swap(particles[i], particles[random.index(static_cast<std::uint32_t>(i + 1))]);
        }
        const auto got = cluster(particles, {});
        ASSERT_EQ(got.size(), want.size());
        for (std::size_t i = 0; i < got.size(); ++i) {
            EXPECT_NEAR(got[i].weight, want[i].weight, 1e-9);
            EXPECT_NEAR(got[i].pose.x, want[i].pose.x, 1e-9);
            EXPECT_NEAR(got[i].covariance(1, 1), want[i].covariance(1, 1), 1e-9);
        }
    }
}

TEST(Clusters, ThereIsAlwaysAHypothesis) {
    Random random(5);
    Particles scattered;
    for (int i = 0; i < 400; ++i) {
        scattered.push_back(
            {{random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(-3, 3)}, 1.0 / 400});
    }
    ASSERT_EQ(cluster(scattered, {}).size(), 1U);
    EXPECT_GT(cluster(scattered, {})[0].covariance(0, 0), 100.0);
    EXPECT_EQ(cluster({{{1, 2, 3}, 1.0}}, {}).size(), 1U);
    EXPECT_TRUE(cluster({}, {}).empty());
}

TEST(Clusters, WeightsNeverSumToMoreThanOne) {
    Random random(6);
    for (int trial = 0; trial < 100; ++trial) {
        Particles particles;
        for (std::uint32_t i = 0; i < 5; ++i) {
            add_blob(particles, {random.uniform(-3, 3), random.uniform(-2, 2), random.uniform(-3, 3)},
                     random.uniform(0, 0.5), random.uniform(0, 1), 10 + static_cast<int>(random.index(100)),
                     random);
        }
        normalise(particles);
        double sum = 0.0;
        double before = 1.0;
        for (const auto& h : cluster(particles, {})) {
            EXPECT_LE(h.weight, before + 1e-12);
            before = h.weight;
            sum += h.weight;
        }
        EXPECT_LE(sum, 1.0 + 1e-9);
    }
}

}  // namespace
}  // namespace goalmouth
