#pragma once

#include "core/field/field.h"
#include "core/localisation/belief.h"
#include "core/localisation/frame_aligner.h"
#include "core/localisation/particle_filter.h"
#include "core/parameters/parameters.h"
#include "core/random/random.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace goalmouth {

struct LocaliserParameters {
    TimingParameters timing;
    ObservationParameters observation;
    FilterParameters filter;
    int particles_every = 5;
};

template <class Visitor>
void describe_parameters(Visitor& v, LocaliserParameters& p) {
    v("particles_every", p.particles_every, Range{0, 1000000}, "1",
      "the particles go out with every one of so many poses; 0: never");
    v.group("timing", p.timing, "how posts, odometry and kinematics are brought together");
    v.group("observation", p.observation, "how posts become bearings and distances from the body");
    v.group("filter", p.filter, "Monte-Carlo localisation");
}

/// What happened since the start.
struct LocaliserCounters {
    std::int64_t restarts = 0;          // the filter began anew: time ran backwards, or a gap nothing bridged
    std::int64_t without_odometry = 0;  // frames
    std::int64_t without_kinematics = 0;  // frames
    std::int64_t odometry_jumps = 0;      // frames between which odometry said what no robot does
    std::int64_t out_of_order = 0;        // messages
    std::int64_t posts_used = 0;
    std::int64_t posts_rejected = 0;
    std::int64_t poses_injected = 0;
};

/// Posts, odometry and kinematics in, in any order; a pose for every frame of posts out, in the frames'
/// order.
class Localiser {
  public:
    struct Output {
        PoseEstimate estimate;
        Particles particles;  // with every n-th pose, else empty
    };

    /// `random` gives the generator for a frame's seq. Throws std::invalid_argument where parameters do not
    /// fit together.
    Localiser(const Field& field, const LocaliserParameters& parameters,
              std::function<Random(std::int64_t)> random);

    std::vector<Output> add(const PostsFrame& frame);
    std::vector<Output> add(const OdometrySample& sample);
    std::vector<Output> add(const KinematicsSample& sample);

    const LocaliserCounters& counters() const { return counters_; }

  private:
    std::vector<Output> run(const std::vector<AlignedFrame>& frames);
    Output step(const AlignedFrame& aligned);
    Motion motion_to(const AlignedFrame& aligned, double seconds);

    Field field_;
    LocaliserParameters parameters_;
    std::function<Random(std::int64_t)> random_;
    FrameAligner aligner_;
    ParticleFilter filter_;
    std::optional<std::int64_t> last_utime_;       // of a frame
    std::optional<OdometrySample> last_odometry_;  // the last known at a frame
    std::int64_t frames_ = 0;
    LocaliserCounters counters_;
};

}  // namespace goalmouth
