#pragma once

#include "core/geometry/pose2.h"
#include "core/localisation/particle.h"
#include "core/parameters/parameters.h"

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// One cluster of the belief.
struct PoseHypothesis {
    double weight = 0.0;  // share of the belief
    Pose2 pose;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of (x, y, theta)
};

/// The belief about the robot's pose at one time: what pose_t says.
struct PoseEstimate {
    std::int64_t utime = 0;
    std::int64_t seq = 0;
    Pose2 pose;  // of the heaviest hypothesis
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    double effective_sample_size = 0.0;
    int posts_used = 0;
    int posts_rejected = 0;
    std::vector<PoseHypothesis> hypotheses;  // at least one, the heaviest first
};

struct ClusterParameters {
    double cell = 0.5;
    int headings = 12;
    double core_share = 0.01;
    double least_share = 0.03;
    int most_hypotheses = 8;
};

template <class Visitor>
void describe_parameters(Visitor& v, ClusterParameters& p) {
    v("cell", p.cell, Range{0.05, 10}, "m",
      "side of the cells particles are sorted into; neighbouring cells are one hypothesis");
    v("headings", p.headings, Range{4, 90}, "1", "cells a full turn is split into");
    v("core_share", p.core_share, Range{0, 1}, "1",
      "share of the belief from which on a cell joins its neighbours to a cluster");
    v("least_share", p.least_share, Range{0, 1}, "1", "clusters with less of the belief are not reported");
    v("most_hypotheses", p.most_hypotheses, Range{1, 64}, "1", "hypotheses reported");
}

/// Mean and covariance of particles, headings averaged on the circle. Covariance is positive definite: a
/// kernel of 1 cm and 0.01 rad is added, below which no belief of this many particles is resolved. `weight`
/// is the sum of their weights. Particles without weight count equally.
PoseHypothesis summarise(const Particles& particles);

/// Clusters of the belief, the heaviest first (ties: the smaller x, y, theta): particles are sorted into
/// cells of (x, y, heading); cells with at least `core_share` of the belief that touch, corners included and
/// headings round the circle, make one cluster; lighter cells go to the heaviest core cell they touch, or to
/// none. Where no cell is a core, the whole belief is one hypothesis. The result does not depend on the
/// particles' order but for rounding. At least one for any particles.
std::vector<PoseHypothesis> cluster(const Particles& particles, const ClusterParameters& parameters);

}  // namespace goalmouth
