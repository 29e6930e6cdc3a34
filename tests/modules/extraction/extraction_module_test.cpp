#include "modules/extraction/extraction_module.h"

#include "core/conversion/segments.h"
#include "core/messaging/channels.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"
#include "core/segmentation/segmentation.h"
#include "tests/support/post_scene.h"

#include <vector>

#include <goalmouth/border_t.hpp>
#include <goalmouth/candidates_t.hpp>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

struct ExtractionModuleTest : testing::Test {
    ExtractionModuleTest() {
        Bus& listener = hub.endpoint("listener");
        subscribe<border_t>(listener, channels::border, [this](const border_t& m) { borders.push_back(m); });
        subscribe<candidates_t>(listener, channels::candidates,
                                [this](const candidates_t& m) { candidates.push_back(m); });
    }
    MemoryHub hub;
    Status status;
    ModuleContext context{hub.endpoint("extraction"), status, "extraction", 1, {}};
    ExtractionModule module{context, {}};
    std::vector<border_t> borders;
    std::vector<candidates_t> candidates;
};

TEST_F(ExtractionModuleTest, FindsBorderAndEdgePoints) {
    const YuyvImage image = scene_image();
    const Intrinsics camera = scaled_to(Intrinsics{}, image.width, image.height);
    const Segments segments =
        segment_frame(image.view(), scene_table(), image_layout(image.width, image.height, {}));
    publish(hub.endpoint("segmentation"), channels::segments, to_message(segments, 77, 7, camera, "scene"));
    hub.run_until_idle();
    ASSERT_EQ(borders.size(), 1U);
    ASSERT_EQ(candidates.size(), 1U);
    EXPECT_EQ(borders[0].seq, 7);
    EXPECT_EQ(candidates[0].utime, 77);
    EXPECT_EQ(borders[0].num_hull, 2);
    EXPECT_FLOAT_EQ(borders[0].hull_y[0], 100.F);
    EXPECT_EQ(candidates[0].num_left, 30);
    EXPECT_EQ(candidates[0].num_right, 30);
    for (const float x : candidates[0].left_x) EXPECT_NEAR(x, 149.5F, 0.1F);
    for (const float x : candidates[0].right_x) EXPECT_NEAR(x, 165.5F, 0.1F);
    EXPECT_EQ(status.outputs(), 1);
}

TEST_F(ExtractionModuleTest, AnswersToAFrameOfNothing) {
    publish(hub.endpoint("segmentation"), channels::segments, to_message(Segments{}, 1, 2, Intrinsics{}, ""));
    hub.run_until_idle();
    ASSERT_EQ(candidates.size(), 1U);
    EXPECT_EQ(candidates[0].num_segments, 0);
    EXPECT_EQ(borders.at(0).num_hull, 0);
}

TEST_F(ExtractionModuleTest, DocumentsEveryParameterInItsFile) {
    const auto file = std::filesystem::path(GOALMOUTH_SOURCE_DIR) / "config" / "modules" / "extraction.yaml";
    const auto loaded = list_parameters(load_parameters<ExtractionModule::Parameters>(file));
    const auto defaults = list_parameters<ExtractionModule::Parameters>();
    for (std::size_t i = 0; i < loaded.size(); ++i)
        EXPECT_EQ(loaded[i].value, defaults[i].value) << loaded[i].key;
}

}  // namespace
}  // namespace goalmouth
