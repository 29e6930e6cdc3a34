#include "core/localisation/frame_aligner.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

constexpr std::size_t most_waiting = 1000;   // frames; a bound against times that make no sense
constexpr std::size_t most_samples = 20000;  // of odometry or kinematics

}  // namespace

std::vector<AlignedFrame> FrameAligner::add(const PostsFrame& frame) {
    if (!accept(posts_, frame.utime)) return {};
    posts_.samples.push_back(frame);
    return release();
}

std::vector<AlignedFrame> FrameAligner::add(const OdometrySample& sample) {
    const auto before = odometry_.latest;
    if (!accept(odometry_, sample.utime)) return {};
    if (before && std::abs(seconds_between(*before, sample.utime)) > parameters_.longest_gap) ++stretch_;
    odometry_.samples.push_back(sample);
    odometry_.samples.back().stretch = stretch_;
    return release();
}

std::vector<AlignedFrame> FrameAligner::add(const KinematicsSample& sample) {
    if (!accept(kinematics_, sample.utime)) return {};
    kinematics_.samples.push_back(sample);
    return release();
}

template <class Sample>
bool FrameAligner::accept(SampleChannel<Sample>& channel, std::int64_t utime) {
    if (!channel.is_next(utime)) {
        if (!channel.runs_back(utime, parameters_.backwards)) {
            ++out_of_order_;
            return false;
        }
        restart(utime);
    }
    channel.latest = utime;
    channel.awaited = true;
    newest_ = newest_ ? std::max(*newest_, utime) : utime;
    return true;
}

void FrameAligner::restart(std::int64_t utime) {
    // What another channel already brought of the new time is kept.
    const auto keep_near = [&](auto& channel) {
        std::erase_if(channel.samples, [&](const auto& s) {
            return std::abs(seconds_between(s.utime, utime)) > parameters_.backwards;
        });
        channel.awaited = true;
        if (!channel.samples.empty()) newest_ = std::max(*newest_, channel.samples.back().utime);
    };
    newest_ = utime;
    keep_near(posts_);
    keep_near(odometry_);
    keep_near(kinematics_);
    ++stretch_;
    restarted_ = true;
}

std::vector<AlignedFrame> FrameAligner::release() {
    std::vector<AlignedFrame> frames;
    while (!posts_.samples.empty()) {
        const std::int64_t utime = posts_.samples.front().utime;
        const bool odometry_came = odometry_.latest && *odometry_.latest >= utime;
        const bool kinematics_came = kinematics_.latest && *kinematics_.latest >= utime;
        const bool complete =
            (odometry_came || !odometry_.awaited) && (kinematics_came || !kinematics_.awaited);
        const bool waited =
            seconds_between(utime, *newest_) >= parameters_.wait || posts_.samples.size() > most_waiting;
        if (!complete && !waited) break;
        if (!odometry_came) odometry_.awaited = false;
        if (!kinematics_came) kinematics_.awaited = false;

        AlignedFrame aligned;
        aligned.frame = std::move(posts_.samples.front());
        posts_.samples.pop_front();
        aligned.odometry = odometry_at(utime);
        aligned.camera = camera_at(kinematics_.samples, utime, parameters_.wait);
        aligned.restarted = restarted_;
        restarted_ = false;
        frames.push_back(std::move(aligned));
        forget_old(utime);
    }
    // Nothing waits for samples this old.
    const auto trim = [&](auto& samples) {
        while (samples.size() > 2 &&
               (seconds_between(samples[1].utime, *newest_) > parameters_.wait + parameters_.longest_gap ||
                samples.size() > most_samples)) {
            samples.pop_front();
        }
    };
    trim(odometry_.samples);
    trim(kinematics_.samples);
    return frames;
}

void FrameAligner::forget_old(std::int64_t frame_utime) {
    const auto forget = [&](auto& samples) {
        while (samples.size() > 1 && samples[1].utime <= frame_utime) samples.pop_front();
    };
    forget(odometry_.samples);
    forget(kinematics_.samples);
}

std::optional<OdometrySample> FrameAligner::odometry_at(std::int64_t utime) const {
    const auto near = around(odometry_.samples, utime);
    if (near.before != nullptr && near.after != nullptr && near.before->stretch == near.after->stretch) {
        const double span = seconds_between(near.before->utime, near.after->utime);
        OdometrySample result = *near.after;
        result.utime = utime;
        if (span > 0.0) {
            result.pose = interpolate(near.before->pose, near.after->pose,
                                      seconds_between(near.before->utime, utime) / span);
        }
        return result;
    }
    if (const OdometrySample* s = nearest(near, utime, parameters_.wait)) {
        OdometrySample result = *s;
        result.utime = utime;
        return result;
    }
    return std::nullopt;
}

}  // namespace goalmouth
