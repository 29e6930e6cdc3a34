#include "core/localisation/frame_aligner.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

constexpr std::size_t most_waiting = 1000;   // frames; a bound against times that make no sense
constexpr std::size_t most_samples = 20000;  // of odometry or kinematics

/// b − a in seconds, whatever the numbers are.
double seconds(std::int64_t a, std::int64_t b) {
    return (static_cast<double>(b) - static_cast<double>(a)) * 1e-6;
}

/// The samples around a time: the last at or before it, and the first at or after it.
template <class Sample>
struct Around {
    const Sample* before = nullptr;
    const Sample* after = nullptr;
};

template <class Sample>
Around<Sample> around(const std::deque<Sample>& samples, std::int64_t utime) {
    const auto next = std::lower_bound(samples.begin(), samples.end(), utime,
                                       [](const Sample& s, std::int64_t t) { return s.utime < t; });
    Around<Sample> result;
    if (next != samples.end()) result.after = &*next;
    if (next != samples.end() && next->utime == utime) {
        result.before = &*next;
    } else if (next != samples.begin()) {
        result.before = &*std::prev(next);
    }
    return result;
}

template <class Sample>
const Sample* nearest(const Around<Sample>& near, std::int64_t utime, double within) {
    const Sample* best = nullptr;
    double distance = within;
    for (const Sample* s : {near.before, near.after}) {
        if (s == nullptr || std::abs(seconds(s->utime, utime)) > distance) continue;
        if (best != nullptr && std::abs(seconds(s->utime, utime)) == distance) continue;
        best = s;
        distance = std::abs(seconds(s->utime, utime));
    }
    return best;
}

CameraPose interpolate(const CameraPose& a, const CameraPose& b, double share) {
    CameraPose result;
    result.T_BC.translation() = (1.0 - share) * a.T_BC.translation() + share * b.T_BC.translation();
    const Eigen::Quaterniond from(a.T_BC.linear());
    const Eigen::Quaterniond to(b.T_BC.linear());
    result.T_BC.linear() = from.slerp(share, to).toRotationMatrix();
    result.covariance = (1.0 - share) * a.covariance + share * b.covariance;
    return result;
}

}  // namespace

std::vector<AlignedFrame> FrameAligner::add(const PostsFrame& frame) {
    if (!accept(posts_, frame.utime)) return {};
    posts_.samples.push_back(frame);
    return release();
}

std::vector<AlignedFrame> FrameAligner::add(const OdometrySample& sample) {
    const auto before = odometry_.latest;
    if (!accept(odometry_, sample.utime)) return {};
    if (before && std::abs(seconds(*before, sample.utime)) > parameters_.longest_gap) ++stretch_;
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
bool FrameAligner::accept(Channel<Sample>& channel, std::int64_t utime) {
    if (channel.latest && utime <= *channel.latest) {
        if (seconds(utime, *channel.latest) <= parameters_.backwards) {
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
            return std::abs(seconds(s.utime, utime)) > parameters_.backwards;
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
            seconds(utime, *newest_) >= parameters_.wait || posts_.samples.size() > most_waiting;
        if (!complete && !waited) break;
        if (!odometry_came) odometry_.awaited = false;
        if (!kinematics_came) kinematics_.awaited = false;

        AlignedFrame aligned;
        aligned.frame = std::move(posts_.samples.front());
        posts_.samples.pop_front();
        aligned.odometry = odometry_at(utime);
        aligned.camera = camera_at(utime);
        aligned.restarted = restarted_;
        restarted_ = false;
        frames.push_back(std::move(aligned));
        forget_old(utime);
    }
    // Nothing waits for samples this old.
    const auto trim = [&](auto& samples) {
        while (samples.size() > 2 &&
               (seconds(samples[1].utime, *newest_) > parameters_.wait + parameters_.longest_gap ||
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
        const double span = seconds(near.before->utime, near.after->utime);
        OdometrySample result = *near.after;
        result.utime = utime;
        if (span > 0.0) {
            result.pose =
                interpolate(near.before->pose, near.after->pose, seconds(near.before->utime, utime) / span);
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

std::optional<CameraPose> FrameAligner::camera_at(std::int64_t utime) const {
    const auto near = around(kinematics_.samples, utime);
    if (near.before != nullptr && near.after != nullptr) {
        if (near.before->utime == utime) return near.before->camera;
        const double span = seconds(near.before->utime, near.after->utime);
        if (span <= parameters_.wait) {
            return interpolate(near.before->camera, near.after->camera,
                               seconds(near.before->utime, utime) / span);
        }
    }
    if (const KinematicsSample* s = nearest(near, utime, parameters_.wait)) return s->camera;
    return std::nullopt;
}

}  // namespace goalmouth
