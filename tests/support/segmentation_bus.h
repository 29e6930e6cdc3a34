#pragma once

#include "core/conversion/camera_pose.h"
#include "core/messaging/channels.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/module.h"
#include "core/process/status.h"
#include "tests/support/post_scene.h"

#include <vector>

#include <gtest/gtest.h>

namespace goalmouth::test {

/// What a segmentation of either kind stands between: a camera, and somebody who hears its segments.
struct SegmentationBus {
    SegmentationBus() {
        subscribe<segments_t>(hub.endpoint("listener"), channels::segments,
                              [this](const segments_t& m) { heard.push_back(m); });
    }
    MemoryHub hub;
    Status status;
    ModuleContext context{hub.endpoint("segmentation"), status, "segmentation", 1, {}};
    std::vector<segments_t> heard;
    Bus& camera = hub.endpoint("camera");
};

/// Of a segmentation that runs with `spacing: field`.
inline void expect_lines_on_the_field_once_the_camera_is_known(SegmentationBus& bus) {
    publish(bus.camera, channels::image, scene_message(0));
    bus.hub.run_until_idle();
    publish(bus.camera, channels::kinematics,
            kinematics_message(camera_in_body(0.4, 0.0, 0.4), scene_message(1).utime, 1));
    publish(bus.camera, channels::image, scene_message(1));
    bus.hub.run_until_idle();
    ASSERT_EQ(bus.heard.size(), 2U);
    EXPECT_NE(bus.heard[0].line_position, bus.heard[1].line_position);
}

}  // namespace goalmouth::test
