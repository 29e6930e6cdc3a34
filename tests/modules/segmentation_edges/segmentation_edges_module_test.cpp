#include "modules/segmentation_edges/segmentation_edges_module.h"

#include "core/conversion/segments.h"
#include "core/messaging/channels.h"
#include "core/messaging/typed.h"
#include "core/messaging/validation.h"
#include "core/process/configuration.h"
#include "tests/support/post_scene.h"
#include "tests/support/segmentation_bus.h"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

struct EdgeSegmentationModuleTest : testing::Test, SegmentationBus {
    EdgeSegmentationModule::Parameters parameters;
};

TEST_F(EdgeSegmentationModuleTest, SegmentsEachFrameUnderItsStamp) {
    EdgeSegmentationModule module(context, parameters);
    publish(camera, channels::image, scene_message(41));
    hub.run_until_idle();
    ASSERT_EQ(heard.size(), 1U);
    EXPECT_EQ(heard[0].seq, 41);
    EXPECT_EQ(heard[0].utime, scene_message(41).utime);
    EXPECT_EQ(heard[0].intrinsics.width, 320);
    EXPECT_EQ(heard[0].num_lines, 60 + 80);
    EXPECT_EQ(status.outputs(), 1);
    const Segments segments = from_message(heard[0]);
    const auto goal = std::find_if(segments.segments.begin(), segments.segments.end(),
                                   [](const Segment& s) { return s.colour == Colour::goal; });
    ASSERT_NE(goal, segments.segments.end());
    EXPECT_NEAR(goal->start, 150, 1);
    EXPECT_NEAR(goal->end, 165, 1);
}

TEST_F(EdgeSegmentationModuleTest, CountsFramesWithoutAField) {
    EdgeSegmentationModule module(context, parameters);
    PostScene none;
    none.field_top = none.height;
    publish(camera, channels::image, scene_message(1, none));
    publish(camera, channels::image, scene_message(2));
    hub.run_until_idle();
    ASSERT_EQ(heard.size(), 1U) << "the newest frame counts";
    publish(camera, channels::image, scene_message(3, none));
    hub.run_until_idle();
    ASSERT_EQ(heard.size(), 2U);
    EXPECT_EQ(status.counters().at("frames_without_field"), 1.0);
    EXPECT_EQ(heard[1].num_lines, heard[0].num_lines);
}

TEST_F(EdgeSegmentationModuleTest, SpacesLinesOnTheFieldOnceItKnowsTheCamera) {
    parameters.scan_lines.spacing = "field";
    EdgeSegmentationModule module(context, parameters);
    expect_lines_on_the_field_once_the_camera_is_known(*this);
}

TEST_F(EdgeSegmentationModuleTest, DocumentsEveryParameterInItsFile) {
    const auto file =
        std::filesystem::path(GOALMOUTH_SOURCE_DIR) / "config" / "modules" / "segmentation_edges.yaml";
    const auto loaded = list_parameters(load_parameters<EdgeSegmentationModule::Parameters>(file));
    const auto defaults = list_parameters<EdgeSegmentationModule::Parameters>();
    ASSERT_EQ(loaded.size(), defaults.size());
    for (std::size_t i = 0; i < loaded.size(); ++i)
        EXPECT_EQ(loaded[i].value, defaults[i].value) << loaded[i].key;
}

}  // namespace
}  // namespace goalmouth
