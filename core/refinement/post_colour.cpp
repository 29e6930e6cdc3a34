#include "core/refinement/post_colour.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace goalmouth {
namespace {

constexpr float darkest = 16.0F;       // luma below which ratios mean nothing
constexpr float ratio_reach = 0.09F;   // of the post's own colour about its commonest ratio
constexpr double black_sigma = 3.0;    // luma, of black_level
constexpr double slope_sigma = 0.004;  // of chroma per luma, beside black's
constexpr double clipped_sigma = 0.3;  // the same where a channel is clipped: the others go on growing
// Of the post's luma, as levels and as light; a side in shadow is hardly darker.
constexpr double shade_level = 0.3, shade_light = 0.07;
constexpr float brightest = 250.0F;  // of red, green, blue from where on they may be

/// BT.601, full range.
float brightest_channel(const PairColour& z) {
    return std::max({z[0] + 1.402F * z[2], z[0] - 0.344136F * z[1] - 0.714136F * z[2], z[0] + 1.772F * z[1]});
}

}  // namespace

Eigen::Matrix3f contrast_matrix(const Eigen::Matrix3f& noise, const Eigen::Vector3f& shade) {
    const Eigen::Matrix3f inverse = noise.inverse();
    const Eigen::Vector3f s = inverse * shade;
    Eigen::Matrix3f m = inverse - s * s.transpose() / shade.dot(s);
    return 0.5F * (m + m.transpose());
}

double RoughOutline::along(const Eigen::Vector2d& top, const Eigen::Vector2d& base, double row) {
    return top.x() + (row - top.y()) / (base.y() - top.y()) * (base.x() - top.x());
}

double RoughOutline::width() const {
    const double row = 0.5 * (first_row + last_row);
    return right(row) - left(row);
}

bool PostColourEstimator::estimate(YuyvView image, const RoughOutline& outline,
                                   const RefinementParameters& parameters, CameraResponse response,
                                   PostColour& colour) {
    constexpr int most_rows = 40;
    constexpr int most_across = 10;
    constexpr double margin = 0.22;  // of the width, on either side
    const float dark = grey_as_read(darkest, response);
    samples_.clear();
    const int rows = outline.last_row - outline.first_row;  // the last one has no row below
    const int lines = std::min(most_rows, rows);
    for (int i = 0; i < lines; ++i) {
        const int y = outline.first_row + static_cast<int>((2LL * i + 1) * rows / (2LL * lines));
        const PairRow upper(image.row(y), image.width / 2, response);
        const PairRow lower(image.row(y + 1), image.width / 2, response);
        const double left = outline.left(y), right = outline.right(y);
        const double inset = margin * (right - left);
        // At least the pair in the middle.
        const int middle = static_cast<int>(std::floor(0.25 * (left + right)));
        const int first = std::min(middle, static_cast<int>(std::ceil(0.5 * (left + inset))));
        const int last = std::max(middle, static_cast<int>(std::floor(0.5 * (right - inset - 1.0))));
        const int step = std::max(1, (last - first + most_across) / most_across);
        for (int pair = first; pair <= last; pair += step) {
            if (pair < 0 || 2 * pair + 1 >= image.width) continue;
            const PairColour one = upper[pair], other = lower[pair];
            const PairColour mean = 0.5F * (one + other);
            if (mean[0] < dark) continue;
            samples_.push_back({mean, one - other, mean.tail<2>() / mean[0]});
        }
    }
    colour = {};
    colour.response = response;
    colour.looked_at = static_cast<int>(samples_.size());
    constexpr std::size_t least_samples = 8;
    if (samples_.size() < least_samples) return false;

    // The commonest ratio: most of the others near it.
    constexpr std::size_t most_candidates = 24;
    const std::size_t jump = std::max<std::size_t>(1, samples_.size() / most_candidates);
    Eigen::Vector2f centre = samples_.front().ratio;
    int most = -1;
    constexpr float reach2 = ratio_reach * ratio_reach;
    for (std::size_t i = jump / 2; i < samples_.size(); i += jump) {
        int count = 0;
        for (std::size_t k = i % 3; k < samples_.size(); k += 3)
            count += (samples_[k].ratio - samples_[i].ratio).squaredNorm() < reach2 ? 1 : 0;
        if (count > most) {
            most = count;
            centre = samples_[i].ratio;
        }
    }
    for (int round = 0; round < 3; ++round) {
        Eigen::Vector2f sum = Eigen::Vector2f::Zero();
        int count = 0;
        for (const Sample& s : samples_) {
            if ((s.ratio - centre).squaredNorm() >= reach2) continue;
            sum += s.ratio;
            ++count;
        }
        if (count > 0) centre = sum / static_cast<float>(count);
    }

    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    int count = 0;
    int clipped = 0;
    for (const Sample& s : samples_) {
        if ((s.ratio - centre).squaredNorm() >= reach2) continue;
        clipped += brightest_channel(s.mean) > brightest ? 1 : 0;
        const Eigen::Vector3d z = s.mean.cast<double>();
        mean += z;
        covariance += z * z.transpose();
        // Clipped, so that a line across the post is no noise.
        const Eigen::Vector3d d = s.difference.cast<double>().cwiseMax(-24.0).cwiseMin(24.0);
        noise += 0.5 * d * d.transpose();
        ++count;
    }
    colour.samples = count;
    if (count < static_cast<int>(least_samples)) return false;
    mean /= count;
    covariance = covariance / count - mean * mean.transpose();
    noise = noise / count + 0.15 * Eigen::Matrix3d::Identity();  // rounding

    // Chroma as a line over luma: what the pixels say, noise discounted, with black's place as prior.
    const double black =
        static_cast<double>(grey_as_read(static_cast<float>(parameters.black_level), response));
    const double luma = std::max(mean[0] - black, static_cast<double>(dark));
    const Eigen::Vector2d prior_slope = mean.tail<2>() / luma;
    const double variance = covariance(0, 0) - 0.5 * noise(0, 0);
    const Eigen::Vector2d shared = covariance.block<2, 1>(1, 0) - 0.5 * noise.block<2, 1>(1, 0);
    const double chroma_noise = 0.25 * (noise(1, 1) + noise(2, 2)) + 1.0;
    const double own_sigma = 20 * clipped > count ? clipped_sigma : slope_sigma;
    const double prior_variance =
        own_sigma * own_sigma + prior_slope.squaredNorm() * black_sigma * black_sigma / (luma * luma);
    // The discounted noise is itself known to √(2/n) only.
    const double unsure = 0.5 * noise(0, 0) * std::sqrt(2.0 / count);
    const double trust = chroma_noise / (count * prior_variance) + unsure;
    const Eigen::Vector2d slope = (trust * prior_slope + shared) / (trust + std::max(variance, 0.0));
    colour.mean = mean.cast<float>();
    colour.shade = {1.0F, static_cast<float>(slope[0]), static_cast<float>(slope[1])};
    if (!colour.shade.allFinite()) return false;
    colour.noise = noise.cast<float>();
    colour.contrast = contrast_matrix(colour.noise, colour.shade);

    const double shade = response == CameraResponse::linear ? shade_level : shade_light;
    float spread = 0.0F;
    for (const Sample& s : samples_) {
        if ((s.ratio - centre).squaredNorm() >= reach2) continue;
        spread += (s.mean - colour.mean).dot(colour.contrast * (s.mean - colour.mean));
    }
    colour.darkest = static_cast<float>(black + shade * (mean[0] - black));
    colour.spread = std::max(1.0F, spread / static_cast<float>(count));  // a mean of two rows: half the noise
    return true;
}

}  // namespace goalmouth
