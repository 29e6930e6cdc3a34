#include "modules/detection_upright/detection_upright_module.h"

#include "core/conversion/candidates.h"
#include "core/conversion/intrinsics.h"
#include "core/conversion/kinematics.h"
#include "core/conversion/posts.h"
#include "core/field/field.h"
#include "core/messaging/channels.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"

#include <exception>
#include <fmt/format.h>
#include <utility>

#include <spdlog/spdlog.h>

namespace goalmouth {

ModuleInfo UprightDetectionModule::info() {
    return {"detection_upright",
            "Finds goalposts as upright things of known diameter and height, both edges at once.",
            {{channels::candidates, "candidates_t", "what may belong to goalposts"},
             {channels::kinematics, "kinematics_t",
              "where the camera was; without it, it is taken to stand about level", true}},
            {{channels::posts, "posts_t", "goalposts of each frame"}}};
}

UprightDetectionModule::UprightDetectionModule(ModuleContext& context, const Parameters& parameters)
    : context_(context),
      detector_(parameters, load_parameters_or_defaults<Field>(parameters.field)),
      aligner_(parameters.timing) {
    subscribe<candidates_t>(context.bus, context.channel(channels::candidates),
                            [this](const candidates_t& message) { take(message); });
    subscribe<kinematics_t>(
        context.bus, context.channel(channels::kinematics), [this](const kinematics_t& message) {
            answer(aligner_.add(from_message(message)));
            context_.status.set("kinematics_out_of_order", static_cast<double>(aligner_.out_of_order()));
        });
}

UprightDetectionModule::~UprightDetectionModule() {
    try {
        answer(aligner_.flush());
    } catch (const std::exception& error) {
        spdlog::error(fmt::format("{} frames are not answered: {}", waiting_.size(), error.what()));
    }
}

void UprightDetectionModule::take(const candidates_t& message) {
    // No pixels are wanted: what the frame waits for is the kinematics alone.
    const FrameMark frame{message.utime, message.seq};
    answer(aligner_.add_picture(frame));
    waiting_.push_back(message);
    answer(aligner_.add_frame(frame, true));
}

void UprightDetectionModule::answer(const std::vector<PictureAligner::Aligned>& frames) {
    for (const PictureAligner::Aligned& aligned : frames) {
        const candidates_t message = std::move(waiting_.front());
        waiting_.pop_front();
        detect(message, aligned.camera);
    }
}

void UprightDetectionModule::detect(const candidates_t& message, const std::optional<CameraPose>& camera) {
    if (!camera) context_.status.count("frames_without_kinematics");
    const Intrinsics intrinsics = from_message(message.intrinsics);
    const auto& posts = detector_.detect(from_message(message), intrinsics, camera);
    publish(context_.bus, context_.channel(channels::posts),
            to_message(posts, message.utime, message.seq, intrinsics, info().executable));
    context_.status.count("posts", static_cast<double>(posts.size()));
    context_.status.output(message.utime);
}

}  // namespace goalmouth
