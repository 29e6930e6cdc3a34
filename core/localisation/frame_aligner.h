#pragma once

#include "core/alignment/kinematics.h"
#include "core/alignment/sample_channel.h"
#include "core/detection/post.h"
#include "core/geometry/camera.h"
#include "core/geometry/pose2.h"
#include "core/localisation/observation.h"
#include "core/parameters/parameters.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace goalmouth {

/// Where the robot's step counting puts it, in its own drifting frame.
struct OdometrySample {
    std::int64_t utime = 0;
    Pose2 pose;
    double translation_noise = -1;  // fractions as in odometry_t; −1 = unknown
    double rotation_noise = -1;
    std::int64_t stretch = 0;  // set by FrameAligner: samples of one stretch have no long gap between them
};

/// The posts of one frame.
struct PostsFrame {
    std::int64_t utime = 0;
    std::int64_t seq = 0;
    Intrinsics intrinsics;
    std::vector<Post> posts;
};

/// A frame with what held when it was taken; what did not come in time is absent.
struct AlignedFrame {
    PostsFrame frame;
    std::optional<OdometrySample> odometry;  // at the frame's utime
    std::optional<CameraPose> camera;
    bool restarted = false;  // time ran backwards since the frame before: nothing old holds
};

struct TimingParameters {
    double wait = 0.2;
    double backwards = 1.0;
    double longest_gap = 5.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, TimingParameters& p) {
    v("wait", p.wait, Range{0, 10}, "s",
      "in data time: posts wait until data this much newer has come for the odometry and kinematics of their "
      "frame");
    v("backwards", p.backwards, Range{0.01, 3600}, "s",
      "time that runs back by more means a new start: a replay began again");
    v("longest_gap", p.longest_gap, Range{0.1, 3600}, "s",
      "a longer silence that odometry does not bridge means a new start");
}

/// Brings posts, odometry and kinematics together, which come on channels of their own in any order.
///
/// A frame leaves when odometry and kinematics at or after its utime are there (each channel is in order, so
/// nothing earlier can follow), or when a message on any channel is newer by `wait`. What leaves is thus a
/// function of the messages alone, not of how they interleave, as long as they interleave by less than
/// `wait`. A channel that let a frame go without is not waited for again until it speaks: images alone work,
/// with the first frames `wait` late.
///
/// Odometry is interpolated between the samples around a frame. Kinematics are the sample of the frame's
/// utime, or interpolated between two at most `wait` apart. Failing that, the nearest sample within `wait` is
/// taken.
///
/// All times are those in the data. Samples that come twice or late on their own channel are skipped and
/// counted.
class FrameAligner {
  public:
    explicit FrameAligner(const TimingParameters& parameters) : parameters_(parameters) {}

    std::vector<AlignedFrame> add(const PostsFrame& frame);
    std::vector<AlignedFrame> add(const OdometrySample& sample);
    std::vector<AlignedFrame> add(const KinematicsSample& sample);

    std::int64_t out_of_order() const { return out_of_order_; }

  private:
    template <class Sample>
    bool accept(SampleChannel<Sample>& channel, std::int64_t utime);
    void restart(std::int64_t utime);
    std::vector<AlignedFrame> release();
    void forget_old(std::int64_t frame_utime);
    std::optional<OdometrySample> odometry_at(std::int64_t utime) const;

    TimingParameters parameters_;
    SampleChannel<PostsFrame> posts_;
    SampleChannel<OdometrySample> odometry_;
    SampleChannel<KinematicsSample> kinematics_;
    std::optional<std::int64_t> newest_;
    std::int64_t stretch_ = 0;
    std::int64_t out_of_order_ = 0;
    bool restarted_ = false;
};

}  // namespace goalmouth
