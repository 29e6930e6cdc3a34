#include "modules/extraction/extraction_module.h"

#include "core/conversion/border.h"
#include "core/conversion/candidates.h"
#include "core/conversion/intrinsics.h"
#include "core/conversion/segments.h"
#include "core/messaging/channels.h"
#include "core/messaging/typed.h"

namespace goalmouth {

ModuleInfo ExtractionModule::info() {
    return {"extraction",
            "Finds the field border and what may belong to goalposts.",
            {{channels::segments, "segments_t", "colour segments of each frame"}},
            {{channels::border, "border_t", "field border of each frame"},
             {channels::candidates, "candidates_t",
              "segments and edge points of each frame that may belong to goalposts"}}};
}

ExtractionModule::ExtractionModule(ModuleContext& context, const Parameters& parameters)
    : context_(context), border_finder_(parameters.border), extractor_(parameters.candidates) {
    subscribe<segments_t>(context.bus, context.channel(channels::segments),
                          [this](const segments_t& message) { extract(message); });
}

void ExtractionModule::extract(const segments_t& message) {
    const Segments segments = from_message(message);
    const Intrinsics camera = from_message(message.intrinsics);
    const FieldBorder& border = border_finder_.find(segments);
    publish(context_.bus, context_.channel(channels::border),
            to_message(border, message.utime, message.seq, camera));
    const Candidates& candidates = extractor_.extract(segments, border);
    publish(context_.bus, context_.channel(channels::candidates),
            to_message(candidates, message.utime, message.seq, camera));
    context_.status.output(message.utime);
}

}  // namespace goalmouth
