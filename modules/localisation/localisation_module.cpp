#include "modules/localisation/localisation_module.h"

#include "core/conversion/kinematics.h"
#include "core/conversion/odometry.h"
#include "core/conversion/particles.h"
#include "core/conversion/pose.h"
#include "core/conversion/posts_frame.h"
#include "core/messaging/channels.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"

#include <stdexcept>

#include <spdlog/spdlog.h>

namespace goalmouth {
namespace {

Localiser make_localiser(const LocalisationModule::Parameters& parameters, const ModuleContext& context) {
    const auto field = load_parameters_or_defaults<Field>(parameters.field);
    try {
        return Localiser(field, parameters.localiser,
                         [&context](std::int64_t seq) { return context.random(seq); });
    } catch (const std::invalid_argument& error) {
        throw ConfigurationError(context.name + ": filter." + error.what());
    }
}

}  // namespace

ModuleInfo LocalisationModule::info() {
    return {"localisation",
            "Monte-Carlo localisation of the robot from goalposts and odometry.",
            {{channels::posts, "posts_t", "goalposts of each frame"},
             {channels::odometry, "odometry_t", "how the robot moved; without it, it may have moved anyhow",
              true},
             {channels::kinematics, "kinematics_t",
              "where the camera was; without it, a level camera is assumed", true}},
            {{channels::pose, "pose_t", "pose on the field for each frame, with covariance and hypotheses"},
             {channels::particles, "particles_t", "the particles behind every few poses"}}};
}

LocalisationModule::LocalisationModule(ModuleContext& context, const Parameters& parameters)
    : context_(context), localiser_(make_localiser(parameters, context)) {
    subscribe<posts_t>(context.bus, context.channel(channels::posts),
                       [this](const posts_t& message) { send(localiser_.add(posts_frame(message))); });
    subscribe<odometry_t>(context.bus, context.channel(channels::odometry),
                          [this](const odometry_t& message) { send(localiser_.add(from_message(message))); });
    subscribe<kinematics_t>(
        context.bus, context.channel(channels::kinematics),
        [this](const kinematics_t& message) { send(localiser_.add(from_message(message))); });
}

void LocalisationModule::send(const std::vector<Localiser::Output>& outputs) {
    for (const Localiser::Output& output : outputs) {
        const PoseEstimate& estimate = output.estimate;
        publish(context_.bus, context_.channel(channels::pose), to_message(estimate));
        context_.status.output(estimate.utime);
        if (!output.particles.empty()) {
            publish(context_.bus, context_.channel(channels::particles),
                    to_message(output.particles, estimate.utime, estimate.seq));
        }
    }
    report();
}

void LocalisationModule::report() {
    const LocaliserCounters& now = localiser_.counters();
    const auto first = [](std::int64_t before, std::int64_t after) { return before == 0 && after > 0; };
    if (now.restarts > reported_.restarts) spdlog::warn("time jumped: localisation starts anew");
    if (first(reported_.without_odometry, now.without_odometry)) spdlog::warn("frames without odometry");
    if (first(reported_.without_kinematics, now.without_kinematics)) {
        spdlog::warn("frames without kinematics: a level camera is assumed");
    }
    if (first(reported_.odometry_jumps, now.odometry_jumps)) spdlog::warn("odometry jumped");
    reported_ = now;
    const auto set = [this](const char* name, std::int64_t value) {
        context_.status.set(name, static_cast<double>(value));
    };
    set("restarts", now.restarts);
    set("frames_without_odometry", now.without_odometry);
    set("frames_without_kinematics", now.without_kinematics);
    set("odometry_jumps", now.odometry_jumps);
    set("messages_out_of_order", now.out_of_order);
    set("posts_used", now.posts_used);
    set("posts_rejected", now.posts_rejected);
    set("poses_injected", now.poses_injected);
}

}  // namespace goalmouth
