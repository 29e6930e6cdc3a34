#include "modules/segmentation/segmentation_module.h"

#include "core/conversion/camera_pose.h"
#include "core/conversion/colour_gains.h"
#include "core/conversion/intrinsics.h"
#include "core/conversion/segments.h"
#include "core/imaging/colour_gains.h"
#include "core/imaging/colour_table_file.h"
#include "core/messaging/channels.h"
#include "core/messaging/image_output.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"
#include "tests/support/data.h"
#include "tests/support/post_scene.h"
#include "tests/support/segmentation_bus.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

struct SegmentationModuleTest : testing::Test, SegmentationBus {
    SegmentationModuleTest() {
        parameters.colours = (folder.path() / "table.gmct").string();
        save_colour_table(scene_table(), parameters.colours);
    }
    TemporaryFolder folder;
    SegmentationModule::Parameters parameters;
};

TEST_F(SegmentationModuleTest, SegmentsEachFrameUnderItsStamp) {
    SegmentationModule module(context, parameters);
    publish(camera, channels::image, scene_message(41));
    hub.run_until_idle();
    ASSERT_EQ(heard.size(), 1U);
    EXPECT_EQ(heard[0].seq, 41);
    EXPECT_EQ(heard[0].utime, scene_message(41).utime);
    EXPECT_EQ(heard[0].table, "scene");
    EXPECT_EQ(heard[0].intrinsics.width, 320);
    EXPECT_EQ(heard[0].num_lines, 60 + 80);
    EXPECT_EQ(status.outputs(), 1);
    const Segments segments = from_message(heard[0]);
    const ScanLine& row = segments.lines[15];  // y = 62
    ASSERT_EQ(row.count, 3);
    EXPECT_EQ(segments.segments[static_cast<std::size_t>(row.first) + 1].start, 150);
    EXPECT_EQ(segments.segments[static_cast<std::size_t>(row.first) + 1].colour, Colour::goal);
}

TEST_F(SegmentationModuleTest, TakesPixelsFromSharedMemoryAlike) {
    SegmentationModule module(context, parameters);
    ImageOutput output(camera, channels::image, "front");
    FrameInfo info;
    info.utime = scene_message(3).utime;
    info.seq = 3;
    info.intrinsics = scene_message(3).intrinsics;
    output.publish(info, scene_image().view());
    hub.run_until_idle();
    publish(camera, channels::image_tap, scene_message(1000));
    hub.run_until_idle();
    ASSERT_EQ(heard.size(), 2U);
    EXPECT_EQ(heard[0].start, heard[1].start);
    EXPECT_EQ(heard[0].transition_offset, heard[1].transition_offset);
}

TEST_F(SegmentationModuleTest, AdaptsItsTableFromTheTimeTheGainsHoldFor) {
    SegmentationModule module(context, parameters);
    const auto has_goal = [](const segments_t& m) {
        return std::find(m.colour.begin(), m.colour.end(), static_cast<std::int8_t>(Colour::goal)) !=
               m.colour.end();
    };
    colour_gains_t gains{};
    gains.utime = scene_message(1).utime;
    gains.from_utime = scene_message(2).utime;
    gains.red = gains.green = 1.0;
    gains.blue = 0.1;  // so what is yellow now was pale
    publish(camera, channels::colour_gains, gains);
    colour_gains_t as_before = gains;
    as_before.from_utime = scene_message(3).utime;
    as_before.blue = 1.0;
    publish(camera, channels::colour_gains, as_before);
    for (int seq = 1; seq <= 3; ++seq) {
        publish(camera, channels::image, scene_message(seq));
        hub.run_until_idle();
    }
    ASSERT_EQ(heard.size(), 3U);
    EXPECT_TRUE(has_goal(heard[0]));
    EXPECT_FALSE(has_goal(heard[1]));
    EXPECT_TRUE(has_goal(heard[2]));
    EXPECT_EQ(heard[0].start, heard[2].start);
}

TEST_F(SegmentationModuleTest, TellsFieldAndPostsApartByWhatTheyAreKnownToLookLike) {
    const ColourTable table = load_colour_table(parameters.colours);
    const ColourGains gains{2.5, 2.5, 2.5};
    const KnownColours known{Eigen::Vector3d(40, 110, 45), Eigen::Vector3d(200, 180, 30)};
    const ColourTable without = adapted(table, gains), with = adapted(table, gains, known);
    std::optional<Ycbcr> told;  // a colour that they decide
    for (int y = 0; y < 256 && !told; y += 4)
        for (int cb = 0; cb < 256 && !told; cb += 4)
            for (int cr = 0; cr < 256 && !told; cr += 4) {
                const Ycbcr p{static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(cb),
                              static_cast<std::uint8_t>(cr)};
                if (without.at(p) != with.at(p)) told = p;
            }
    ASSERT_TRUE(told);
    SegmentationModule module(context, parameters);
    FrameInfo info;
    info.utime = 2'000'000;
    info.intrinsics = to_message(Intrinsics{});
    publish(camera, channels::colour_gains, to_message(gains, known, info.utime, 1, info.utime));
    YuyvImage image(info.intrinsics.width, info.intrinsics.height);
    for (std::size_t i = 0; i < image.data.size(); i += 4) {
        image.data[i] = image.data[i + 2] = told->y;
        image.data[i + 1] = told->cb;
        image.data[i + 3] = told->cr;
    }
    publish(camera, channels::image, self_contained_yuyv(info, "c", image.view()));
    hub.run_until_idle();
    ASSERT_EQ(heard.size(), 1U);
    ASSERT_FALSE(heard[0].colour.empty());
    for (const auto colour : heard[0].colour) EXPECT_EQ(colour, static_cast<std::int8_t>(with.at(*told)));
}

TEST_F(SegmentationModuleTest, SpacesLinesOnTheFieldOnceItKnowsTheCamera) {
    parameters.scan_lines.spacing = "field";
    SegmentationModule module(context, parameters);
    expect_lines_on_the_field_once_the_camera_is_known(*this);
}

TEST_F(SegmentationModuleTest, IgnoresACameraPoseYoungerThanTheFrame) {
    parameters.scan_lines.spacing = "field";
    SegmentationModule module(context, parameters);
    publish(camera, channels::kinematics,
            kinematics_message(camera_in_body(0.4, 0.0, 0.4), scene_message(9).utime, 9));
    publish(camera, channels::image, scene_message(0));
    hub.run_until_idle();
    ASSERT_EQ(heard.size(), 1U);
    EXPECT_EQ(heard[0].line_position[0], 2);
}

TEST_F(SegmentationModuleTest, SaysWhichTableIsMissing) {
    parameters.colours = "/no/such/table.gmct";
    try {
        SegmentationModule module(context, parameters);
        FAIL() << "accepted a missing table";
    } catch (const ConfigurationError& error) {
        EXPECT_NE(std::string(error.what()).find("/no/such/table.gmct"), std::string::npos);
    }
    parameters.colours = "";
    EXPECT_THROW(SegmentationModule(context, parameters), ConfigurationError);
}

TEST_F(SegmentationModuleTest, DocumentsEveryParameterInItsFile) {
    const auto file =
        std::filesystem::path(GOALMOUTH_SOURCE_DIR) / "config" / "modules" / "segmentation.yaml";
    const auto loaded = list_parameters(load_parameters<SegmentationModule::Parameters>(file));
    const auto defaults = list_parameters<SegmentationModule::Parameters>();
    ASSERT_EQ(loaded.size(), defaults.size());
    for (std::size_t i = 0; i < loaded.size(); ++i) {
        if (loaded[i].key != "colours") {
            EXPECT_EQ(loaded[i].value, defaults[i].value) << loaded[i].key;
        }
    }
}

}  // namespace
}  // namespace goalmouth
