#include "tests/core/refinement/photographed_edge.h"

#include "core/evaluation/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace goalmouth::test {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

Vector3d draw(const Eigen::Matrix3d& covariance, Random& random) {
    const Eigen::Matrix3d root = covariance.llt().matrixL();
    return root * Vector3d(random.normal(), random.normal(), random.normal());
}

/// The two combinations of (Y, Cb, Cr) that the post's colour, however bright, leaves at 0.
Eigen::Matrix<double, 2, 3> complement(const Vector3d& post) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(post, Eigen::ComputeFullU);
    return svd.matrixU().rightCols<2>().transpose();
}

}  // namespace

Vector3d from_rgb(const Vector3d& rgb) {
    Eigen::Matrix3d m;
    m << 0.299, 0.587, 0.114, -0.168736, -0.331264, 0.5, 0.5, -0.418688, -0.081312;
    return m * rgb;
}

const Vector3d yellow = from_rgb({226.0, 184.0, 34.0});
const Vector3d grey = from_rgb({186.0, 186.0, 190.0});
const Vector3d carpet = from_rgb({52.0, 122.0, 62.0});

EdgeLook yellow_before(const Vector3d& background, double post_noise, double background_noise) {
    EdgeLook look;
    look.post = yellow;
    look.background = background;
    look.post_noise = ycbcr_noise(Vector3d::Constant(post_noise));
    look.background_noise = ycbcr_noise(Vector3d::Constant(background_noise));
    return look;
}

Coverage::Coverage(double blur, const Vector2d& normal) {
    constexpr int subpixels = 8;
    for (int i = 0; i <= count_; ++i) {
        double sum = 0.0;
        for (int v = 0; v < subpixels; ++v)
            for (int u = 0; u < subpixels; ++u) {
                const Vector2d off = Vector2d(u + 0.5, v + 0.5) / subpixels - Vector2d::Constant(0.5);
                const double t = -reach_ + 2.0 * reach_ * i / count_ + normal.dot(off);
                sum += 0.5 * std::erfc(-t / (blur * std::numbers::sqrt2));
            }
        table_.push_back(sum / (subpixels * subpixels));
    }
}

double Coverage::operator()(double t) const {
    const double at = std::clamp((t + reach_) / (2.0 * reach_), 0.0, 1.0) * count_;
    const auto i = std::min(static_cast<std::size_t>(at), static_cast<std::size_t>(count_ - 1));
    const double share = at - static_cast<double>(i);
    return (1.0 - share) * table_[i] + share * table_[i + 1];
}

std::vector<Vector3d> photograph(const std::vector<Pair>& pairs, const Covered& covered, Random& random) {
    std::vector<Vector3d> values;
    for (const Pair& pair : pairs) {
        Vector3d mean = Vector3d::Zero();
        double luma = 0.0;
        for (int k = 0; k < 2; ++k) {
            const double c = covered(pair.x + k, pair.y);
            const EdgeLook& look = *pair.look;
            const double brightness = random.uniform(0.6, 1.0);
            const Vector3d level = c * brightness * look.post + (1.0 - c) * look.background +
                                   draw(c * look.post_noise + (1.0 - c) * look.background_noise, random);
            mean += 0.5 * level;
            luma += 0.5 * std::round(level.x());
        }
        values.push_back({luma, std::round(mean.y()), std::round(mean.z())});
    }
    return values;
}

Eigen::VectorXd fit(const std::vector<Pair>& pairs, const std::vector<Vector3d>& values,
                    const std::function<Covered(const Eigen::VectorXd&)>& covered_by, Eigen::VectorXd guess,
                    const Eigen::VectorXd& steps) {
    constexpr int iterations = 4;
    const Eigen::Matrix<double, 2, 3> b = complement(yellow);  // of all posts here
    const Eigen::Index unknowns = guess.size();
    const auto share = [](const Covered& covered, const Pair& pair) {
        return 0.5 * (covered(pair.x, pair.y) + covered(pair.x + 1, pair.y));
    };
    for (int n = 0; n < iterations; ++n) {
        const Covered here = covered_by(guess);
        std::vector<Covered> above, below;
        for (Eigen::Index k = 0; k < unknowns; ++k) {
            const Eigen::VectorXd off = Eigen::VectorXd::Unit(unknowns, k) * steps[k];
            above.push_back(covered_by(guess + off));
            below.push_back(covered_by(guess - off));
        }
        Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
        Eigen::VectorXd rhs = Eigen::VectorXd::Zero(unknowns);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const EdgeLook& look = *pairs[i].look;
            const double c = share(here, pairs[i]);
            Eigen::Matrix3d noise = 0.5 * (c * look.post_noise + (1.0 - c) * look.background_noise);
            noise.diagonal() += Vector3d(1.0, 2.0, 2.0) / 24.0;
            const Eigen::Matrix2d weight = (b * noise * b.transpose()).inverse();
            const Vector2d background = b * look.background;
            const Vector2d residual = b * values[i] - (1.0 - c) * background;
            Eigen::RowVectorXd rate(unknowns);
            for (Eigen::Index k = 0; k < unknowns; ++k) {
                const auto at = static_cast<std::size_t>(k);
                rate[k] = -(share(above[at], pairs[i]) - share(below[at], pairs[i])) / (2.0 * steps[k]);
            }
            const double information = background.dot(weight * background);
            normal += information * rate.transpose() * rate;
            rhs += background.dot(weight * residual) * rate.transpose();
        }
        guess += normal.ldlt().solve(rhs);
    }
    return guess;
}

void expect_reached(const std::vector<double>& errors, double bound) {
    const ErrorStatistics statistics = error_statistics(errors).value();
    const auto tries = static_cast<double>(errors.size());
    const double chance = 1.0 / std::sqrt(2.0 * tries);  // relative σ of an RMSE
    EXPECT_GT(statistics.rmse, bound * (1.0 - 3.0 * chance)) << "less than the bound " << bound;
    EXPECT_LT(statistics.rmse, bound * (1.03 + 3.0 * chance)) << "not near the bound " << bound;
    EXPECT_LT(std::abs(statistics.bias), 0.1 * bound + 3.0 * bound / std::sqrt(tries));
}

}  // namespace goalmouth::test
