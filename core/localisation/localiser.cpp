#include "core/localisation/localiser.h"

#include <utility>

namespace goalmouth {

Localiser::Localiser(const Field& field, const LocaliserParameters& parameters,
                     std::function<Random(std::int64_t)> random)
    : field_(field),
      parameters_(parameters),
      random_(std::move(random)),
      aligner_(parameters.timing),
      filter_(field, parameters.filter) {}

std::vector<Localiser::Output> Localiser::add(const PostsFrame& frame) {
    return run(aligner_.add(frame));
}
std::vector<Localiser::Output> Localiser::add(const OdometrySample& sample) {
    return run(aligner_.add(sample));
}
std::vector<Localiser::Output> Localiser::add(const KinematicsSample& sample) {
    return run(aligner_.add(sample));
}

std::vector<Localiser::Output> Localiser::run(const std::vector<AlignedFrame>& frames) {
    counters_.out_of_order = aligner_.out_of_order();
    std::vector<Output> outputs;
    outputs.reserve(frames.size());
    for (const AlignedFrame& aligned : frames) outputs.push_back(step(aligned));
    return outputs;
}

Motion Localiser::motion_to(const AlignedFrame& aligned, double seconds) {
    Motion motion;
    motion.seconds = seconds;
    if (!aligned.odometry) {
        ++counters_.without_odometry;
        return motion;
    }
    const OdometrySample now = *aligned.odometry;
    const auto before = std::exchange(last_odometry_, now);
    if (!before || before->stretch != now.stretch) return motion;
    motion.known = true;
    motion.step = difference(before->pose, now.pose);
    motion.translation_noise = now.translation_noise;
    motion.rotation_noise = now.rotation_noise;
    Motion since = motion;
    since.seconds = seconds_between(before->utime, now.utime);
    if (is_jump(since, parameters_.filter.motion)) {
        ++counters_.odometry_jumps;
        motion.known = false;
        motion.step = {};
    }
    return motion;
}

Localiser::Output Localiser::step(const AlignedFrame& aligned) {
    Random random = random_(aligned.frame.seq);
    const double seconds = last_utime_ ? seconds_between(*last_utime_, aligned.frame.utime) : 0.0;
    const Motion motion = motion_to(aligned, seconds);
    const bool unbridged = seconds > parameters_.timing.longest_gap && !motion.known;
    if (!last_utime_ || aligned.restarted || unbridged) {
        if (last_utime_) ++counters_.restarts;
        filter_.start(random);
        frames_ = 0;
    } else {
        filter_.predict(motion, random);
    }
    const double elapsed = frames_ == 0 ? 0.0 : seconds;
    last_utime_ = aligned.frame.utime;

    if (!aligned.camera) ++counters_.without_kinematics;
    const CameraPose camera = aligned.camera.value_or(assumed_camera(parameters_.observation));
    const FrameObservation observation = observe_posts(aligned.frame.posts, aligned.frame.intrinsics, camera,
                                                       field_.post_diameter, parameters_.observation);
    filter_.update(observation, elapsed, random);

    Output output;
    output.estimate = filter_.estimate();
    output.estimate.utime = aligned.frame.utime;
    output.estimate.seq = aligned.frame.seq;
    if (parameters_.particles_every > 0 && frames_ % parameters_.particles_every == 0)
        output.particles = filter_.particles();
    ++frames_;
    counters_.posts_used += output.estimate.posts_used;
    counters_.posts_rejected += output.estimate.posts_rejected;
    counters_.poses_injected = filter_.injected();
    return output;
}

}  // namespace goalmouth
