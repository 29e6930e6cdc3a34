#include "core/conversion/pose.h"

#include "core/geometry/pose2.h"

namespace goalmouth {
namespace {

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

}  // namespace

pose_hypothesis_t to_message(const PoseHypothesis& hypothesis) {
    pose_hypothesis_t m{};
    m.weight = hypothesis.weight;
    m.x = hypothesis.pose.x;
    m.y = hypothesis.pose.y;
    m.theta = wrap_angle(hypothesis.pose.theta);
    Eigen::Map<RowMajor>(m.covariance) = hypothesis.covariance;
    return m;
}

PoseHypothesis from_message(const pose_hypothesis_t& m) {
    PoseHypothesis hypothesis;
    hypothesis.weight = m.weight;
    hypothesis.pose = {m.x, m.y, m.theta};
    hypothesis.covariance = Eigen::Map<const RowMajor>(m.covariance);
    return hypothesis;
}

pose_t to_message(const PoseEstimate& estimate) {
    pose_t m{};
    m.utime = estimate.utime;
    m.seq = estimate.seq;
    m.x = estimate.pose.x;
    m.y = estimate.pose.y;
    m.theta = wrap_angle(estimate.pose.theta);
    Eigen::Map<RowMajor>(m.covariance) = estimate.covariance;
    m.effective_sample_size = estimate.effective_sample_size;
    m.posts_used = estimate.posts_used;
    m.posts_rejected = estimate.posts_rejected;
    m.num_hypotheses = static_cast<std::int32_t>(estimate.hypotheses.size());
    for (const PoseHypothesis& hypothesis : estimate.hypotheses)
        m.hypotheses.push_back(to_message(hypothesis));
    return m;
}

PoseEstimate from_message(const pose_t& m) {
    PoseEstimate estimate;
    estimate.utime = m.utime;
    estimate.seq = m.seq;
    estimate.pose = {m.x, m.y, m.theta};
    estimate.covariance = Eigen::Map<const RowMajor>(m.covariance);
    estimate.effective_sample_size = m.effective_sample_size;
    estimate.posts_used = m.posts_used;
    estimate.posts_rejected = m.posts_rejected;
    for (const pose_hypothesis_t& hypothesis : m.hypotheses)
        estimate.hypotheses.push_back(from_message(hypothesis));
    return estimate;
}

}  // namespace goalmouth
