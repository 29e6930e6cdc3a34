#pragma once

#include "core/geometry/pose2.h"
#include "core/parameters/parameters.h"
#include "core/random/random.h"

#include <cstdint>

namespace goalmouth {

/// How badly the robot counts its own steps. `translation_noise` and `rotation_noise` are σ of a single
/// step's error as a share of what it moved; `constant_share` of that σ is one scale error for the whole run
/// (a worn sole), the rest is drawn anew with each step (slip), so that the total stays as stated.
struct OdometryParameters {
    double translation_noise = 0.2;
    double rotation_noise = 0.3;
    double constant_share = 0.4;
    double heading_slip = 0.1;
};

template <class Visitor>
void describe_parameters(Visitor& v, OdometryParameters& p) {
    v("translation_noise", p.translation_noise, Range{0, 1}, "1",
      "σ of a step's length and of its side slip, as a fraction of the distance walked");
    v("rotation_noise", p.rotation_noise, Range{0, 1}, "1",
      "σ of a step's turn, as a fraction of the angle turned");
    v("constant_share", p.constant_share, Range{0, 1}, "1",
      "share of both σ that is one scale error for the whole run");
    v("heading_slip", p.heading_slip, Range{0, 2}, "rad/m", "σ of a step's turn that nobody asked for");
}

/// Dead reckoning that drifts: adds up measured steps in a frame of its own.
class OdometryModel {
  public:
    /// `run` is what the whole run's errors are drawn from.
    OdometryModel(const OdometryParameters& parameters, Random run);

    /// The robot moved by `motion`, in its own frame, during footstep number `footstep` (which never
    /// decreases).
    void move(const Pose2& motion, std::int64_t footstep);
    const Pose2& pose() const { return pose_; }

  private:
    void draw_slip();

    OdometryParameters parameters_;
    Random random_;
    double length_scale_;
    double turn_scale_;
    double length_slip_ = 0.0;
    double side_slip_ = 0.0;
    double turn_slip_ = 0.0;
    double heading_slip_ = 0.0;
    std::int64_t footstep_ = 0;
    Pose2 pose_;
};

}  // namespace goalmouth
