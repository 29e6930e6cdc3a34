#include "modules/detection_ransac/detection_ransac_module.h"

#include "core/conversion/candidates.h"
#include "core/conversion/intrinsics.h"
#include "core/conversion/posts.h"
#include "core/field/field.h"
#include "core/messaging/channels.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"

namespace goalmouth {

ModuleInfo RansacDetectionModule::info() {
    return {"detection_ransac",
            "Finds goalposts as pairs of lines fitted to edge points by RANSAC.",
            {{channels::candidates, "candidates_t", "what may belong to goalposts"}},
            {{channels::posts, "posts_t", "goalposts of each frame"}}};
}

RansacDetectionModule::RansacDetectionModule(ModuleContext& context, const Parameters& parameters)
    : context_(context),
      detector_(parameters, load_parameters_or_defaults<Field>(parameters.field).post_diameter) {
    subscribe<candidates_t>(context.bus, context.channel(channels::candidates),
                            [this](const candidates_t& message) { detect(message); });
}

void RansacDetectionModule::detect(const candidates_t& message) {
    const Intrinsics camera = from_message(message.intrinsics);
    Random random = context_.random(message.seq);
    const auto& posts = detector_.detect(from_message(message), camera, random);
    publish(context_.bus, context_.channel(channels::posts),
            to_message(posts, message.utime, message.seq, camera, info().executable));
    context_.status.count("posts", static_cast<double>(posts.size()));
    context_.status.output(message.utime);
}

}  // namespace goalmouth
