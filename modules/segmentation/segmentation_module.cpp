#include "modules/segmentation/segmentation_module.h"

#include "core/conversion/camera_pose.h"
#include "core/conversion/intrinsics.h"
#include "core/conversion/segments.h"
#include "core/imaging/colour_table_file.h"
#include "core/imaging/file_error.h"
#include "core/messaging/channels.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"

namespace goalmouth {
namespace {

ColourTable load_table(const std::string& file) {
    if (file.empty()) {
        throw ConfigurationError(
            "segmentation: no colour table: set `colours` to a .gmct file, such as "
            "config/colours/simulator.gmct");
    }
    try {
        return load_colour_table(file);
    } catch (const FileError& error) {
        throw ConfigurationError(std::string("segmentation: ") + error.what());
    }
}

}  // namespace

ModuleInfo SegmentationModule::info() {
    return {"segmentation",
            "Labels the pixels on scan-lines by colour and cuts the lines into segments.",
            {{channels::image, "image_t", "camera frames, pixels in shared memory"},
             {channels::image_tap, "image_t", "self-contained frames, for replay", true},
             {channels::image_slices, "image_slice_t", "self-contained frames in pieces, for replay", true},
             {channels::kinematics, "kinematics_t",
              "camera pose, where scan-lines are equidistant on the field", true}},
            {{channels::segments, "segments_t", "colour segments of each frame"}}};
}

SegmentationModule::SegmentationModule(ModuleContext& context, const Parameters& parameters)
    : SegmentationModule(context, parameters, load_table(parameters.colours)) {}

SegmentationModule::SegmentationModule(ModuleContext& context, const Parameters& parameters,
                                       const ColourTable& table)
    : context_(context),
      table_name_(table.name()),
      segmenter_(table),
      layout_(parameters.scan_lines),
      images_(context.bus, context.channel(channels::image), context.channel(channels::image_tap),
              context.channel(channels::image_slices), [this](const Frame& frame) { segment(frame); }) {
    subscribe<kinematics_t>(
        context.bus, context.channel(channels::kinematics),
        [this](const kinematics_t& message) { poses_.add(message.utime, camera_pose(message)); });
}

void SegmentationModule::segment(const Frame& frame) {
    context_.status.dropped(frame.dropped_before);
    const Intrinsics camera = from_message(frame.intrinsics);
    const ScanLayout& layout = layout_.at(camera, poses_.at(frame.utime));
    const Segments& segments = segmenter_.segment(frame.pixels, layout);
    if (!frame.still_valid()) {
        context_.status.dropped(1);
        return;
    }
    const segments_t message = to_message(segments, frame.utime, frame.seq, camera, table_name_);
    context_.status.count("lines_left_out", message.lines_left_out);
    publish(context_.bus, context_.channel(channels::segments), message);
    context_.status.output(frame.utime);
}

}  // namespace goalmouth
