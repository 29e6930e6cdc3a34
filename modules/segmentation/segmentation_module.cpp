#include "modules/segmentation/segmentation_module.h"

#include "core/conversion/camera_pose.h"
#include "core/conversion/colour_gains.h"
#include "core/conversion/intrinsics.h"
#include "core/conversion/segments.h"
#include "core/messaging/channels.h"
#include "core/messaging/typed.h"
#include "core/process/colour_table_parameter.h"

#include <cstddef>
#include <iterator>

namespace goalmouth {
namespace {

constexpr std::size_t gains_kept = 64;
constexpr std::int64_t backwards = 1'000'000;  // µs

}  // namespace

ModuleInfo SegmentationModule::info() {
    return {"segmentation",
            "Labels the pixels on scan-lines by colour and cuts the lines into segments.",
            {{channels::image, "image_t", "camera frames, pixels in shared memory"},
             {channels::image_tap, "image_t", "self-contained frames, for replay", true},
             {channels::image_slices, "image_slice_t", "self-contained frames in pieces, for replay", true},
             {channels::kinematics, "kinematics_t",
              "camera pose, where scan-lines are equidistant on the field", true},
             {channels::colour_gains, "colour_gains_t",
              "how light has changed since the table was made; without it the table stays as it is", true}},
            {{channels::segments, "segments_t", "colour segments of each frame"}}};
}

SegmentationModule::SegmentationModule(ModuleContext& context, const Parameters& parameters)
    : SegmentationModule(context, parameters, colour_table_parameter(parameters.colours, info().executable)) {
}

SegmentationModule::SegmentationModule(ModuleContext& context, const Parameters& parameters,
                                       const ColourTable& table)
    : context_(context),
      table_(table),
      segmenter_(std::in_place, table),
      layout_(parameters.scan_lines),
      images_(context.bus, context.channel(channels::image), context.channel(channels::image_tap),
              context.channel(channels::image_slices), [this](const Frame& frame) { segment(frame); }) {
    subscribe<kinematics_t>(
        context.bus, context.channel(channels::kinematics),
        [this](const kinematics_t& message) { poses_.add(message.utime, camera_pose(message)); });
    subscribe<colour_gains_t>(
        context.bus, context.channel(channels::colour_gains), [this](const colour_gains_t& message) {
            // Time ran back: a replay began again.
            if (!lights_.empty() && message.from_utime < lights_.rbegin()->first - backwards) lights_.clear();
            lights_[message.from_utime] = {from_message(message), known_colours(message)};
            if (lights_.size() > gains_kept) lights_.erase(lights_.begin());
        });
}

void SegmentationModule::adapt_to(std::int64_t utime) {
    const auto after = lights_.upper_bound(utime);
    const Light light = after == lights_.begin() ? Light{} : std::prev(after)->second;
    if (light == applied_) return;
    segmenter_.emplace(adapted(table_, light.gains, light.known));
    applied_ = light;
}

void SegmentationModule::segment(const Frame& frame) {
    context_.status.dropped(frame.dropped_before);
    const Intrinsics camera = from_message(frame.intrinsics);
    const ScanLayout& layout = layout_.at(camera, poses_.at(frame.utime));
    adapt_to(frame.utime);
    const Segments& segments = segmenter_->segment(frame.pixels, layout);
    if (!frame.still_valid()) {
        context_.status.dropped(1);
        return;
    }
    const segments_t message = to_message(segments, frame.utime, frame.seq, camera, table_.name());
    context_.status.count("lines_left_out", message.lines_left_out);
    publish(context_.bus, context_.channel(channels::segments), message);
    context_.status.output(frame.utime);
}

}  // namespace goalmouth
