#pragma once

#include "core/alignment/kinematics.h"
#include "core/alignment/sample_channel.h"
#include "core/geometry/camera_pose.h"
#include "core/parameters/parameters.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace goalmouth {

/// A frame as all messages about it name it.
struct FrameMark {
    std::int64_t utime = 0;
    std::int64_t seq = 0;
    bool operator==(const FrameMark&) const = default;
};

struct PictureTimingParameters {
    double wait = 0.2;
    double silence = 1.0;
    double backwards = 1.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, PictureTimingParameters& p) {
    v("wait", p.wait, Range{0, 10}, "s",
      "in data time: until data this much newer has come, posts wait for their picture and the kinematics of "
      "their frame; 0: never, what has come before them counts");
    v("silence", p.silence, Range{0, 3600}, "s",
      "pictures or kinematics that have been silent for longer are not waited for");
    v("backwards", p.backwards, Range{0.01, 3600}, "s",
      "time that runs back by more means a new start: a replay began again");
}

/// Brings what was found in frames together with the frames' pictures and where the camera was, which come on
/// channels of their own in any order.
///
/// A frame leaves when its picture, and kinematics at or after its utime, are there; or when a message on any
/// channel is newer by `wait`; or at once where nothing is wanted of its picture or where none is to be
/// expected. Pictures are expected while some came within `silence` of the frame, and of frames within `wait`
/// of the first; kinematics likewise. Frames leave in the order they were added. What leaves with what is
/// thus a function of the messages alone, not of how they interleave, as long as they interleave by less than
/// `wait` (only where pictures come back after a silence are the first of them taken as they come).
///
/// Pictures may come in any order, as of several cameras or some in slices; a frame's own one is what counts.
/// All times are those in the data.
class PictureAligner {
  public:
    struct Aligned {
        FrameMark frame;
        bool has_picture = false;          // its picture was announced
        std::optional<CameraPose> camera;  // at its utime
    };

    explicit PictureAligner(const PictureTimingParameters& parameters) : parameters_(parameters) {}

    /// `wants_picture`: false where there is nothing to look at.
    std::vector<Aligned> add_frame(const FrameMark& frame, bool wants_picture);
    /// The picture is at hand, or is known to be lost: waiting for it is of no use.
    std::vector<Aligned> add_picture(const FrameMark& picture);
    std::vector<Aligned> add(const KinematicsSample& sample);
    /// All that wait: nothing more will come.
    std::vector<Aligned> flush();

    /// Kinematics that came twice or late on their channel, and were skipped.
    std::int64_t out_of_order() const { return out_of_order_; }

  private:
    struct Waiting {
        FrameMark frame;
        bool wants_picture = false;
    };

    bool runs_back(const std::optional<std::int64_t>& latest, std::int64_t utime) const;
    std::vector<Aligned> restart(std::int64_t utime);
    std::vector<Aligned> release();
    Aligned take_first();
    bool has_picture(const FrameMark& frame) const;
    bool at_the_start(std::int64_t utime) const;
    bool picture_expected(std::int64_t utime) const;
    bool kinematics_expected(std::int64_t utime) const;
    bool waits(const Waiting& first) const;
    void forget_old();

    PictureTimingParameters parameters_;
    std::deque<Waiting> waiting_;
    std::deque<FrameMark> pictures_;  // the latest, in the order they came
    SampleChannel<KinematicsSample> kinematics_;
    std::optional<std::int64_t> latest_frame_;
    std::optional<std::int64_t> latest_picture_;
    std::optional<std::int64_t> newest_;
    std::optional<std::int64_t> start_;  // of the first frame
    std::int64_t out_of_order_ = 0;
};

}  // namespace goalmouth
