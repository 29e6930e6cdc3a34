#include "core/alignment/picture_aligner.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace goalmouth {
namespace {

// Bounds against times that make no sense.
constexpr std::size_t most_waiting = 1000;
constexpr std::size_t most_pictures = 1000;
constexpr std::size_t most_samples = 20000;

void append(std::vector<PictureAligner::Aligned>& to, std::vector<PictureAligner::Aligned> more) {
    to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

std::vector<PictureAligner::Aligned> PictureAligner::add_frame(const FrameMark& frame, bool wants_picture) {
    std::vector<Aligned> left;
    if (runs_back(latest_frame_, frame.utime)) left = restart(frame.utime);
    latest_frame_ = std::max(latest_frame_.value_or(frame.utime), frame.utime);
    newest_ = std::max(newest_.value_or(frame.utime), frame.utime);
    if (!start_) start_ = frame.utime;
    waiting_.push_back({frame, wants_picture});
    append(left, release());
    return left;
}

std::vector<PictureAligner::Aligned> PictureAligner::add_picture(const FrameMark& picture) {
    std::vector<Aligned> left;
    if (runs_back(latest_picture_, picture.utime)) left = restart(picture.utime);
    latest_picture_ = std::max(latest_picture_.value_or(picture.utime), picture.utime);
    newest_ = std::max(newest_.value_or(picture.utime), picture.utime);
    pictures_.push_back(picture);
    append(left, release());
    return left;
}

std::vector<PictureAligner::Aligned> PictureAligner::add(const KinematicsSample& sample) {
    std::vector<Aligned> left;
    if (!kinematics_.is_next(sample.utime)) {
        if (!kinematics_.runs_back(sample.utime, parameters_.backwards)) {
            ++out_of_order_;
            return left;
        }
        left = restart(sample.utime);
    }
    kinematics_.latest = sample.utime;
    kinematics_.samples.push_back(sample);
    newest_ = std::max(newest_.value_or(sample.utime), sample.utime);
    append(left, release());
    return left;
}

std::vector<PictureAligner::Aligned> PictureAligner::flush() {
    std::vector<Aligned> left;
    while (!waiting_.empty()) left.push_back(take_first());
    return left;
}

bool PictureAligner::runs_back(const std::optional<std::int64_t>& latest, std::int64_t utime) const {
    return latest && seconds_between(utime, *latest) > parameters_.backwards;
}

/// What waits from before time ran back will see nothing of its time any more. What another channel already
/// brought of the new time is kept.
std::vector<PictureAligner::Aligned> PictureAligner::restart(std::int64_t utime) {
    const auto is_far = [&](std::int64_t t) {
        return std::abs(seconds_between(t, utime)) > parameters_.backwards;
    };
    std::vector<Aligned> left;
    while (!waiting_.empty() && is_far(waiting_.front().frame.utime)) left.push_back(take_first());
    std::erase_if(pictures_, [&](const FrameMark& p) { return is_far(p.utime); });
    std::erase_if(kinematics_.samples, [&](const KinematicsSample& s) { return is_far(s.utime); });

    newest_ = utime;
    latest_frame_.reset();
    latest_picture_.reset();
    start_.reset();
    for (const Waiting& w : waiting_) {
        latest_frame_ = std::max(latest_frame_.value_or(w.frame.utime), w.frame.utime);
        if (!start_) start_ = w.frame.utime;
    }
    for (const FrameMark& p : pictures_)
        latest_picture_ = std::max(latest_picture_.value_or(p.utime), p.utime);
    kinematics_.latest.reset();
    if (!kinematics_.samples.empty()) kinematics_.latest = kinematics_.samples.back().utime;
    for (const auto& latest : {latest_frame_, latest_picture_, kinematics_.latest})
        newest_ = std::max(*newest_, latest.value_or(*newest_));
    return left;
}

std::vector<PictureAligner::Aligned> PictureAligner::release() {
    std::vector<Aligned> left;
    while (!waiting_.empty() && !waits(waiting_.front())) left.push_back(take_first());
    forget_old();
    return left;
}

PictureAligner::Aligned PictureAligner::take_first() {
    const FrameMark frame = waiting_.front().frame;
    waiting_.pop_front();
    return {frame, has_picture(frame), camera_at(kinematics_.samples, frame.utime, parameters_.wait)};
}

bool PictureAligner::waits(const Waiting& first) const {
    const std::int64_t utime = first.frame.utime;
    if (!first.wants_picture || waiting_.size() > most_waiting) return false;
    if (seconds_between(utime, *newest_) >= parameters_.wait) return false;
    if (!has_picture(first.frame)) return picture_expected(utime);
    const bool kinematics_came = kinematics_.latest && *kinematics_.latest >= utime;
    return !kinematics_came && kinematics_expected(utime);
}

bool PictureAligner::has_picture(const FrameMark& frame) const {
    return std::find(pictures_.begin(), pictures_.end(), frame) != pictures_.end();
}

bool PictureAligner::at_the_start(std::int64_t utime) const {
    return start_ && std::abs(seconds_between(*start_, utime)) < parameters_.wait;
}

bool PictureAligner::picture_expected(std::int64_t utime) const {
    return at_the_start(utime) || std::any_of(pictures_.begin(), pictures_.end(), [&](const FrameMark& p) {
               return std::abs(seconds_between(p.utime, utime)) <= parameters_.silence;
           });
}

bool PictureAligner::kinematics_expected(std::int64_t utime) const {
    return at_the_start(utime) ||
           (kinematics_.latest && seconds_between(*kinematics_.latest, utime) <= parameters_.silence);
}

void PictureAligner::forget_old() {
    const double old = parameters_.wait + parameters_.silence + parameters_.backwards;
    while (!pictures_.empty() &&
           (seconds_between(pictures_.front().utime, *newest_) > old || pictures_.size() > most_pictures)) {
        pictures_.pop_front();
    }
    auto& samples = kinematics_.samples;
    while (samples.size() > 2 &&
           (seconds_between(samples[1].utime, *newest_) > old || samples.size() > most_samples)) {
        samples.pop_front();
    }
}

}  // namespace goalmouth
