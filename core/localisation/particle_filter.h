#pragma once

#include "core/field/field.h"
#include "core/localisation/belief.h"
#include "core/localisation/motion_model.h"
#include "core/localisation/observation.h"
#include "core/localisation/particle.h"
#include "core/localisation/prior.h"
#include "core/localisation/sensor_model.h"
#include "core/parameters/parameters.h"
#include "core/random/random.h"

namespace goalmouth {

/// When the belief no longer explains what is seen, poses drawn from the observations are mixed in.
struct RecoveryParameters {
    double below = 0.4;
    double memory = 1.0;
    double rate = 0.5;
    double mirror_share = 0.1;
};

template <class Visitor>
void describe_parameters(Visitor& v, RecoveryParameters& p) {
    v("below", p.below, Range{0, 1}, "1",
      "poses are injected while the belief explains less than this share of the posts; 0: never");
    v("memory", p.memory, Range{0.01, 60}, "s", "time over which that share is averaged");
    v("rate", p.rate, Range{0, 10}, "1/s",
      "share of the particles replaced each second when nothing is explained");
    v("mirror_share", p.mirror_share, Range{0, 1}, "1",
      "injected poses that may face the other way than what was believed: 0 trusts the old side of the "
      "point-symmetric field, "
      "1 takes either");
}

struct FilterParameters {
    int particles = 400;
    int start_particles = 2000;
    double resample_below = 0.5;
    PriorParameters initial;
    MotionParameters motion;
    SensorModelParameters sensor;
    RecoveryParameters recovery;
    ClusterParameters clusters;
};

template <class Visitor>
void describe_parameters(Visitor& v, FilterParameters& p) {
    v("particles", p.particles, Range{10, 4000}, "1", "number of particles; 4000 fill a datagram");
    v("start_particles", p.start_particles, Range{10, 4000}, "1",
      "number of particles from the start to the first resampling: a prior is wider than a belief");
    v("resample_below", p.resample_below, Range{0, 1}, "1",
      "resample when the effective sample size falls below this share of the particles");
    v.group("initial", p.initial, "where the robot may be at the start");
    v.group("motion", p.motion, "how far odometry is trusted");
    v.group("sensor", p.sensor, "how posts are told apart and how much they weigh");
    v.group("recovery", p.recovery, "what happens when the belief explains the posts no more");
    v.group("clusters", p.clusters, "how the belief becomes hypotheses");
}

/// Monte-Carlo localisation on a field whose only landmarks are four goalposts (Thrun, Burgard, Fox,
/// Probabilistic Robotics, chapter 8). One step for each frame: predict by the motion since the last one,
/// update by the frame's posts.
class ParticleFilter {
  public:
    /// Throws std::invalid_argument where the start poses do not fit together.
    ParticleFilter(const Field& field, const FilterParameters& parameters);

    /// Forgets everything and draws the prior.
    void start(Random& random);

    void predict(const Motion& motion, Random& random);

    /// Weighs the particles by what the frame shows, `seconds` after the last one. Weights become w ·
    /// p(z|x)^α with α by SensorModel::news of the time since posts were last seen. Resamples when the
    /// effective sample size is low; injects poses (augmented MCL: by the running mean of the share of
    /// observations the belief explained before it saw them, which, unlike the mean likelihood, does not
    /// depend on how many posts there are or how far). For refined posts each particle stands for its
    /// neighbourhood (regularisation.h).
    void update(const FrameObservation& frame, double seconds, Random& random);

    const Particles& particles() const { return particles_; }
    /// utime and seq are left to the caller. The effective sample size is that of the last update, before it
    /// resampled.
    PoseEstimate estimate() const;
    /// Running mean of the explained share, 0…1.
    double fit() const { return fit_; }
    /// Poses injected since the filter was made.
    std::int64_t injected() const { return injected_; }

  private:
    void weigh(const FrameObservation& frame, double seconds);
    int poses_to_inject(const FrameObservation& frame, double seconds, Random& random) const;
    void resample(const FrameObservation& frame, int inject, Random& random);

    Field field_;
    FilterParameters parameters_;
    SensorModel model_;
    Particles particles_;
    double effective_sample_size_ = 0.0;
    double fit_ = 1.0;
    double since_posts_ = 0.0;  // s
    int posts_used_ = 0;
    int posts_rejected_ = 0;
    std::int64_t injected_ = 0;
};

}  // namespace goalmouth
