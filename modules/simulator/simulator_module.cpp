#include "modules/simulator/simulator_module.h"

#include "core/conversion/intrinsics.h"
#include "core/conversion/simulated_frame.h"
#include "core/conversion/truth.h"
#include "core/messaging/channels.h"
#include "core/messaging/clock.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"

#include <stdexcept>

namespace goalmouth {
namespace {

constexpr std::int64_t whole_run = -1;  // in place of a frame's number: what is drawn once

Simulation make_simulation(const SimulatorParameters& p, const ModuleContext& context) {
    try {
        const auto formation = load_parameters_or_defaults<ImageFormationParameters>(p.scene);
        return Simulation({formation, p.walk, p.kinematics}, load_parameters_or_defaults<Field>(p.field),
                          load_parameters_or_defaults<Intrinsics>(p.camera), context.random(whole_run));
    } catch (const std::invalid_argument& error) {
        throw ConfigurationError(error.what());
    }
}

}  // namespace

ModuleInfo SimulatorModule::info() {
    return {
        "simulator",
        "A robot that walks on a soccer field: its images, odometry and kinematics, and the truth.",
        {},
        {{channels::kinematics, "kinematics_t", "with each frame: where the robot measured its camera to be"},
         {channels::odometry, "odometry_t", "with each frame: where the robot's step counting puts it"},
         {channels::truth, "truth_t", "with each frame: where everything is; not for modules under test"},
         {channels::image, "image_t", "each frame, its pixels in a ring of shared memory"},
         {channels::camera_info, "camera_info_t", "once a second: which camera sends"}}};
}

SimulatorModule::SimulatorModule(ModuleContext& context, const Parameters& parameters)
    : context_(context),
      parameters_(parameters),
      simulation_(make_simulation(parameters, context)),
      output_(context.bus, context.channel(channels::image), parameters.camera_name),
      info_output_(context.bus, context.channel(channels::camera_info)) {}

void SimulatorModule::start() {
    clock_.emplace(utime_or_now(parameters_.start_time), parameters_.frames_per_second);
    started_ = Clock::now();
}

std::chrono::microseconds SimulatorModule::since_start() const {
    return std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - started_);
}

/// Renders ahead of time, so that a frame leaves when it is due and not a rendering time later.
void SimulatorModule::prepare() {
    const auto memory = buffer_.prepare(image_, simulation_.camera().width, simulation_.camera().height);
    Random random = context_.random(seq_);
    frame_ = simulation_.capture(clock_->seconds(time_), random, memory.data(), image_.stride);
    prepared_ = true;
}

void SimulatorModule::send() {
    FrameInfo info;
    info.utime = clock_->utime(time_);
    info.seq = seq_;
    info.intrinsics = to_message(simulation_.camera());

    Bus& bus = context_.bus;
    publish(bus, context_.channel(channels::kinematics), kinematics_message(frame_, info.utime, seq_));
    publish(bus, context_.channel(channels::odometry),
            odometry_message(frame_, parameters_.walk.odometry, info.utime, seq_));
    publish(bus, context_.channel(channels::truth), to_message(frame_.truth, info.utime, seq_));
    if (output_.publish(info, image_)) {
        context_.status.output(info.utime);
    } else {
        context_.status.dropped(1);
    }
    for (const auto& [name, value] : output_.counters()) context_.status.set(name, value);

    camera_info_t camera{};
    camera.utime = info.utime;
    camera.camera = parameters_.camera_name;
    camera.source = "simulator";
    camera.frames_per_second = parameters_.frames_per_second;
    camera.intrinsics = info.intrinsics;
    info_output_.announce(camera);

    prepared_ = false;
    ++seq_;
    ++time_;
    if (parameters_.frames > 0 && seq_ >= parameters_.frames)
        end_ = Clock::now() +
               std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(parameters_.linger));
}

std::chrono::microseconds SimulatorModule::tick() {
    using std::chrono::microseconds;
    if (end_) return std::chrono::milliseconds(10);
    if (!clock_) start();
    if (!prepared_) {
        if (parameters_.realtime) {
            const std::int64_t latest = clock_->latest(clock_->utime(0) + since_start().count());
            if (latest > time_) {
                context_.status.count("late_frames", static_cast<double>(latest - time_));
                time_ = latest;
            }
        }
        prepare();
    }
    if (parameters_.realtime) {
        const microseconds due(clock_->utime(time_) - clock_->utime(0));
        const microseconds now = since_start();
        if (now < due) return due - now;
    }
    send();
    return microseconds(0);
}

bool SimulatorModule::finished() const {
    return end_ && Clock::now() >= *end_;
}

}  // namespace goalmouth
