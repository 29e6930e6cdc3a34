#include "tools/evaluate/images_measures.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace goalmouth {
namespace {

constexpr double distance_step = 0.5;  // m
/// An outline that ends nearer to the picture's side than this [px] may go on beyond it; as
/// MeasurementParameters::border_margin.
constexpr double cut_margin = 6.0;

std::optional<double> x_at(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double row) {
    if (a.y() == b.y()) return std::nullopt;
    return a.x() + (b.x() - a.x()) * (row - a.y()) / (b.y() - a.y());
}

std::optional<double> difference(const std::optional<double>& a, const std::optional<double>& b) {
    if (!a || !b) return std::nullopt;
    return *a - *b;
}

std::optional<ErrorStatistics> pooled(const std::vector<MeasuredPost>& posts,
                                      std::array<std::optional<double>, 3> EdgeErrors::*which) {
    std::vector<double> errors;
    for (const MeasuredPost& post : posts)
        for (const auto& error : post.edges.*which)
            if (error) errors.push_back(*error);
    return error_statistics(errors);
}

}  // namespace

EdgeErrors edge_errors(const ReferencePost& truth, const Post& detection, int picture_width) {
    const double top = 0.5 * (truth.left_top.y() + truth.right_top.y());
    const double base = 0.5 * (truth.left_base.y() + truth.right_base.y());
    // So near to the picture's side an outline follows that rather than the post.
    const auto inside = [&](std::optional<double> x) {
        return x && *x >= cut_margin && *x <= picture_width - 1.0 - cut_margin ? x : std::nullopt;
    };
    const auto unless = [&](std::uint32_t flag, std::optional<double> x) {
        return detection.has(flag) ? std::nullopt : x;
    };
    EdgeErrors errors;
    for (std::size_t i = 0; i < edge_heights.size(); ++i) {
        const double row = top + edge_heights[i] * (base - top);
        errors.left[i] = difference(
            unless(post_flag::left_edge_missing, x_at(detection.left_top, detection.left_base, row)),
            inside(x_at(truth.left_top, truth.left_base, row)));
        errors.right[i] = difference(
            unless(post_flag::right_edge_missing, x_at(detection.right_top, detection.right_base, row)),
            inside(x_at(truth.right_top, truth.right_base, row)));
        errors.width[i] = difference(errors.right[i], errors.left[i]);
    }
    return errors;
}

std::optional<double> MeasuredPost::distance_error() const {
    return difference(distance, true_distance);
}

double MeasuredPost::largest_edge_error() const {
    double largest = 0.0;
    for (const auto& side : {edges.left, edges.right})
        for (const auto& error : side) largest = std::max(largest, std::abs(error.value_or(0.0)));
    return largest;
}

std::vector<MeasuredPost> measured_posts(const std::vector<const ScoredPicture*>& pictures) {
    std::vector<MeasuredPost> posts;
    for (const ScoredPicture* picture : pictures) {
        for (std::size_t i = 0; i < picture->truth.size(); ++i) {
            const auto detection = picture->matching.identified[i];
            if (!detection) continue;
            const Post& post = picture->result.posts[*detection];
            MeasuredPost one{picture, i, *detection, {}, {}, {}};
            one.edges = edge_errors(picture->truth[i], post, picture->result.camera.width);
            if (const auto& placed = picture->placed[i]) one.true_distance = placed->distance;
            if (!post.has(post_flag::no_distance)) one.distance = post.distance_m;
            posts.push_back(one);
        }
    }
    return posts;
}

std::vector<MeasuredGroup> groups(const std::vector<MeasuredPost>& posts) {
    MeasuredGroup refined{"refined", {}};
    MeasuredGroup others{"not refined", {}};
    for (const MeasuredPost& post : posts) (post.refined() ? refined : others).posts.push_back(post);
    if (refined.posts.empty()) others.name = "all";
    std::vector<MeasuredGroup> all;
    for (MeasuredGroup* group : {&refined, &others})
        if (!group->posts.empty()) all.push_back(std::move(*group));
    return all;
}

EdgeSummary edge_summary(const std::vector<MeasuredPost>& posts) {
    EdgeSummary summary{posts.size(),
                        pooled(posts, &EdgeErrors::left),
                        pooled(posts, &EdgeErrors::right),
                        pooled(posts, &EdgeErrors::width),
                        {}};
    double squares = 0.0;
    int stated = 0;
    for (const MeasuredPost& post : posts) {
        const auto& sigma = post.picture->annotated.edge_sigmas[post.truth];
        if (!sigma) continue;
        squares += *sigma * *sigma;
        ++stated;
    }
    if (stated > 0) summary.annotation_sigma = std::sqrt(squares / stated);
    return summary;
}

std::vector<DistanceSample> distance_samples(const std::vector<MeasuredPost>& posts) {
    std::vector<DistanceSample> samples;
    for (const MeasuredPost& post : posts)
        if (post.true_distance) samples.push_back({*post.true_distance, post.distance});
    return samples;
}

std::optional<double> outline_distance(const ReferencePost& outline, const Intrinsics& camera,
                                       double diameter) {
    const auto ray = [&](const Eigen::Vector2d& pixel) -> Eigen::Vector3d {
        return normalised_from_pixel(camera, pixel).homogeneous();
    };
    for (const Eigen::Vector2d& end :
         {outline.left_top, outline.left_base, outline.right_top, outline.right_base})
        if (!(end.x() >= cut_margin && end.x() <= camera.width - 1.0 - cut_margin)) return std::nullopt;
    const Eigen::Vector3d top = ray(0.5 * (outline.left_top + outline.right_top));
    const Eigen::Vector3d base = ray(0.5 * (outline.left_base + outline.right_base));
    const Eigen::Vector3d axis = top.cross(base).cross(top.normalized() + base.normalized());
    const Eigen::Vector3d left = ray(0.5 * (outline.left_top + outline.left_base)).cross(axis).normalized();
    const Eigen::Vector3d right =
        ray(0.5 * (outline.right_top + outline.right_base)).cross(axis).normalized();
    const double half_angle = 0.5 * std::atan2(left.cross(right).norm(), left.dot(right));
    if (!(half_angle > 0.0)) return std::nullopt;
    return 0.5 * diameter / std::sin(half_angle);
}

std::vector<DistanceSample> outline_samples(const std::vector<const ScoredPicture*>& pictures,
                                            double diameter) {
    std::vector<DistanceSample> samples;
    for (const ScoredPicture* picture : pictures) {
        for (std::size_t i = 0; i < picture->truth.size(); ++i) {
            if (!picture->placed[i]) continue;
            samples.push_back({picture->placed[i]->distance,
                               outline_distance(picture->truth[i], picture->result.camera, diameter)});
        }
    }
    return samples;
}

std::optional<DistanceSummary> distance_summary(const std::vector<DistanceSample>& samples) {
    DistanceSummary summary;
    std::vector<double> errors;
    std::vector<double> relative;
    for (const DistanceSample& sample : samples) {
        if (sample.estimate) {
            errors.push_back(*sample.estimate - sample.truth);
            relative.push_back(errors.back() / sample.truth);
        } else {
            ++summary.without;
        }
    }
    const auto absolute = error_statistics(errors);
    const auto shares = error_statistics(relative);
    if (!absolute || !shares) return std::nullopt;
    summary.posts = errors.size();
    summary.errors = *absolute;
    summary.relative_rms = shares->rmse;
    summary.median_relative = shares->median_abs;
    summary.to = HUGE_VAL;
    return summary;
}

std::vector<DistanceSummary> by_distance(const std::vector<DistanceSample>& samples) {
    std::map<int, std::vector<DistanceSample>> steps;
    for (const DistanceSample& sample : samples)
        steps[static_cast<int>(std::floor(sample.truth / distance_step))].push_back(sample);
    std::vector<DistanceSummary> summaries;
    for (const auto& [step, those] : steps) {
        auto summary = distance_summary(those);
        if (!summary) continue;
        summary->from = step * distance_step;
        summary->to = (step + 1) * distance_step;
        summaries.push_back(*summary);
    }
    return summaries;
}

PlacementSummary placement_summary(const std::vector<const ScoredPicture*>& pictures) {
    PlacementSummary summary;
    double squares = 0.0;
    for (const ScoredPicture* picture : pictures) {
        if (!picture->place) continue;
        for (const auto& placed : picture->placed) {
            ++summary.posts;
            if (placed)
                squares += placed->direction_error * placed->direction_error;
            else
                ++summary.unplaced;
        }
    }
    if (summary.posts > summary.unplaced)
        summary.direction_rms = std::sqrt(squares / static_cast<double>(summary.posts - summary.unplaced));
    return summary;
}

}  // namespace goalmouth
