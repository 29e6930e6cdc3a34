#include "modules/segmentation_edges/segmentation_edges_module.h"

#include "core/conversion/camera_pose.h"
#include "core/conversion/intrinsics.h"
#include "core/conversion/segments.h"
#include "core/field/field.h"
#include "core/messaging/channels.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"

#include <optional>

namespace goalmouth {

ModuleInfo EdgeSegmentationModule::info() {
    return {"segmentation_edges",
            "Finds posts and field on scan-lines by edges, without a colour table.",
            {{channels::image, "image_t", "camera frames, pixels in shared memory"},
             {channels::image_tap, "image_t", "self-contained frames, for replay", true},
             {channels::image_slices, "image_slice_t", "self-contained frames in pieces, for replay", true},
             {channels::kinematics, "kinematics_t",
              "camera pose: how large posts look, and scan-lines equidistant on the field", true}},
            {{channels::segments, "segments_t", "segments of each frame: posts, field, anything else"}}};
}

EdgeSegmentationModule::EdgeSegmentationModule(ModuleContext& context, const Parameters& parameters)
    : context_(context),
      diameter_(load_parameters_or_defaults<Field>(parameters.field).post_diameter),
      segmenter_(parameters.segmentation),
      layout_(parameters.scan_lines),
      images_(context.bus, context.channel(channels::image), context.channel(channels::image_tap),
              context.channel(channels::image_slices), [this](const Frame& frame) { segment(frame); }) {
    subscribe<kinematics_t>(
        context.bus, context.channel(channels::kinematics),
        [this](const kinematics_t& message) { poses_.add(message.utime, camera_pose(message)); });
}

void EdgeSegmentationModule::segment(const Frame& frame) {
    context_.status.dropped(frame.dropped_before);
    const Intrinsics camera = from_message(frame.intrinsics);
    const auto T_BC = poses_.at(frame.utime);
    std::optional<CameraOverGround> view;
    if (T_BC) view = {camera, *T_BC, diameter_};
    const Segments& segments =
        segmenter_.segment(frame.pixels, layout_.at(camera, T_BC), view ? &*view : nullptr);
    if (!frame.still_valid()) {
        context_.status.dropped(1);
        return;
    }
    const segments_t message = to_message(segments, frame.utime, frame.seq, camera, "edges");
    context_.status.count("lines_left_out", message.lines_left_out);
    context_.status.count("frames_without_field", segmenter_.field() ? 0.0 : 1.0);
    publish(context_.bus, context_.channel(channels::segments), message);
    context_.status.output(frame.utime);
}

}  // namespace goalmouth
