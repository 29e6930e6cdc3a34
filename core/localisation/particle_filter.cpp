#include "core/localisation/particle_filter.h"

#include "core/localisation/pose_candidates.h"
#include "core/localisation/regularisation.h"
#include "core/localisation/resampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace goalmouth {
namespace {

constexpr double long_ago = 1e9;  // s

/// Logarithms of weights to weights that sum to 1; the highest is finite.
void exponentiate(std::vector<double>& logs) {
    const double highest = *std::max_element(logs.begin(), logs.end());
    double total = 0.0;
    for (double& w : logs) total += w = std::exp(w - highest);
    for (double& w : logs) w /= total;
}

}  // namespace

ParticleFilter::ParticleFilter(const Field& field, const FilterParameters& parameters)
    : field_(field), parameters_(parameters), model_(field, parameters.sensor) {
    if (const std::string problem = prior_problem(parameters.initial); !problem.empty()) {
        throw std::invalid_argument(problem);
    }
}

void ParticleFilter::start(Random& random) {
    particles_ = draw_prior(field_, parameters_.initial, parameters_.start_particles, random);
    effective_sample_size_ = effective_sample_size(particles_);
    fit_ = 1.0;
    since_posts_ = long_ago;
    posts_used_ = posts_rejected_ = 0;
}

void ParticleFilter::predict(const Motion& motion, Random& random) {
    move_particles(particles_, motion, parameters_.motion, random);
}

void ParticleFilter::update(const FrameObservation& frame, double seconds, Random& random) {
    weigh(frame, std::max(0.0, seconds));
    effective_sample_size_ = effective_sample_size(particles_);
    const int inject = poses_to_inject(frame, seconds, random);
    const double enough = parameters_.resample_below * static_cast<double>(particles_.size());
    if (inject > 0 || effective_sample_size_ < enough) resample(frame, inject, random);
}

void ParticleFilter::weigh(const FrameObservation& frame, double seconds) {
    since_posts_ += seconds;
    const double place_share = model_.news(seconds);
    const double share = frame.posts.empty() ? 0.0 : model_.news(since_posts_);
    if (!frame.posts.empty()) since_posts_ = 0.0;

    // p^α of a normal density is one of 1/α times the variance: what a kernel spans is added to that.
    const bool any_refined = std::any_of(frame.posts.begin(), frame.posts.end(),
                                         [](const PostObservation& z) { return z.refined; });
    FrameObservation wide;
    FrameObservation tempered_wide;
    if (any_refined) {
        const PoseHypothesis belief = cluster(particles_, parameters_.clusters).front();
        const double kernel = kernel_share(particles_.size());
        wide = widened(frame, belief, kernel);
        tempered_wide = widened(frame, belief, share * kernel);
    }

    // w p(z|x)^α becomes the weight; w p(z|x), the whole of what the frame says, tells which of its posts are
    // posts of the field.
    std::vector<double> tempered(particles_.size());
    std::vector<double> whole(particles_.size());
    std::vector<std::array<double, SensorModel::most_observations>> explained_each(particles_.size());
    double explained = 0.0;
    for (std::size_t i = 0; i < particles_.size(); ++i) {
        const Particle& p = particles_[i];
        const auto likelihood = model_.likelihood(p.pose, any_refined ? wide : frame);
        const double log = any_refined ? model_.likelihood(p.pose, tempered_wide).log : likelihood.log;
        explained_each[i] = likelihood.explained_each;
        explained += p.weight * likelihood.explained;
        const double before = std::log(std::max(p.weight, 1e-300));
        tempered[i] = before + share * log + place_share * model_.log_place(p.pose);
        whole[i] = before + likelihood.log;
    }
    exponentiate(tempered);
    exponentiate(whole);
    for (std::size_t i = 0; i < particles_.size(); ++i) particles_[i].weight = tempered[i];

    posts_used_ = 0;
    for (std::size_t k = 0; k < std::min(frame.posts.size(), SensorModel::most_observations); ++k) {
        double belief = 0.0;
        for (std::size_t i = 0; i < particles_.size(); ++i) belief += whole[i] * explained_each[i][k];
        if (belief > 0.5) ++posts_used_;
    }
    posts_rejected_ = static_cast<int>(frame.posts.size()) - posts_used_ + frame.unusable;
    if (!frame.posts.empty())
        fit_ += (explained - fit_) * (1.0 - std::exp(-seconds / parameters_.recovery.memory));
}

int ParticleFilter::poses_to_inject(const FrameObservation& frame, double seconds, Random& random) const {
    const double below = parameters_.recovery.below;
    if (frame.posts.empty() || !(fit_ < below)) return 0;
    const double share = std::min(0.5, parameters_.recovery.rate * seconds) * (1.0 - fit_ / below);
    // Rounded at random, so that small shares are not lost.
    return static_cast<int>(share * parameters_.particles + random.uniform());
}

void ParticleFilter::resample(const FrameObservation& frame, int inject, Random& random) {
    std::vector<double> weights;
    weights.reserve(particles_.size());
    for (const Particle& p : particles_) weights.push_back(p.weight);
    const auto count = static_cast<std::size_t>(parameters_.particles);
    Particles chosen;
    chosen.reserve(count);
    const auto keep = count - std::min(count - 1, static_cast<std::size_t>(inject));
    for (const std::size_t i : systematic_resample(weights, keep, random)) chosen.push_back(particles_[i]);

    while (chosen.size() < count) {
        const auto witness = random.index(static_cast<std::uint32_t>(keep));
        const bool either_side = random.uniform() < parameters_.recovery.mirror_share;
        const auto drawn = draw_pose(frame, model_, random);
        Pose2 pose = drawn ? *drawn : chosen[witness].pose;
        // A robot that was carried or fell still tends to face the way it did; its mirror image on the field
        // does not.
        const double turn = std::abs(wrap_angle(pose.theta - chosen[witness].pose.theta));
        if (!either_side && turn > std::numbers::pi / 2.0) pose = mirrored(pose);
        if (drawn) ++injected_;
        chosen.push_back({pose, 0.0});
    }
    for (Particle& p : chosen) p.weight = 1.0 / static_cast<double>(count);
    particles_ = std::move(chosen);
}

PoseEstimate ParticleFilter::estimate() const {
    PoseEstimate result;
    result.hypotheses = cluster(particles_, parameters_.clusters);
    if (!result.hypotheses.empty()) {
        result.pose = result.hypotheses.front().pose;
        result.covariance = result.hypotheses.front().covariance;
    }
    result.effective_sample_size = effective_sample_size_;
    result.posts_used = posts_used_;
    result.posts_rejected = posts_rejected_;
    return result;
}

}  // namespace goalmouth
