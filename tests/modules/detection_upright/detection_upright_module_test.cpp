#include "modules/detection_upright/detection_upright_module.h"

#include "core/conversion/camera_pose.h"
#include "core/conversion/candidates.h"
#include "core/imaging/colour_table_file.h"
#include "core/messaging/channels.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"
#include "modules/extraction/extraction_module.h"
#include "modules/segmentation/segmentation_module.h"
#include "tests/support/data.h"
#include "tests/support/example_messages.h"
#include "tests/support/post_scene.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

/// The module with somebody who listens.
struct Rig {
    explicit Rig(const UprightDetectionModule::Parameters& parameters = {})
        : module(std::make_unique<UprightDetectionModule>(context, parameters)) {
        subscribe<posts_t>(hub.endpoint("listener"), channels::posts,
                           [this](const posts_t& m) { heard.push_back(m); });
    }
    void send_candidates(std::int64_t seq) {
        publish(mouth, channels::candidates, to_message(Candidates{}, time_of(seq), seq, Intrinsics{}));
        hub.run_until_idle();
    }
    void send_kinematics(std::int64_t seq) {
        publish(mouth, channels::kinematics,
                kinematics_message(camera_in_body(0.4, 0.0, 0.0), time_of(seq), seq));
        hub.run_until_idle();
    }
    static std::int64_t time_of(std::int64_t seq) { return 1'000'000 + 33'000 * seq; }
    double counter(const char* name) const {
        const auto found = status.counters().find(name);
        return found == status.counters().end() ? 0.0 : found->second;
    }

    MemoryHub hub;
    Status status;
    ModuleContext context{hub.endpoint("detection"), status, "detection", 1, {}};
    Bus& mouth = hub.endpoint("mouth");
    std::vector<posts_t> heard;
    std::unique_ptr<UprightDetectionModule> module;
};

TEST(UprightDetectionModule, FindsThePostFromPixelsToPosts) {
    TemporaryFolder folder;
    SegmentationModule::Parameters segmentation;
    segmentation.colours = (folder.path() / "table.gmct").string();
    save_colour_table(scene_table(), segmentation.colours);
    UprightDetectionModule::Parameters parameters;
    parameters.timing.wait = 0.0;
    Rig rig(parameters);
    Status status;
    ModuleContext first{rig.hub.endpoint("segmentation"), status, "segmentation", 1, {}};
    ModuleContext second{rig.hub.endpoint("extraction"), status, "extraction", 1, {}};
    SegmentationModule segment(first, segmentation);
    ExtractionModule extract(second, {});
    publish(rig.mouth, channels::image, scene_message(0));
    rig.hub.run_until_idle();
    ASSERT_EQ(rig.heard.size(), 1U);
    EXPECT_EQ(rig.heard[0].detector, "detection_upright");
    ASSERT_EQ(rig.heard[0].num_posts, 1);
    EXPECT_NEAR(rig.heard[0].posts[0].left_top[0], 149.5, 1.0);
    EXPECT_NEAR(rig.heard[0].posts[0].right_base[0], 165.5, 1.0);
    EXPECT_EQ(rig.counter("frames_without_kinematics"), 1.0);
}

TEST(UprightDetectionModule, AnswersAFrameOnceItsKinematicsAreThereInWhateverOrder) {
    Rig rig;
    rig.send_candidates(0);
    EXPECT_TRUE(rig.heard.empty());
    rig.send_kinematics(0);
    ASSERT_EQ(rig.heard.size(), 1U);
    rig.send_kinematics(1);
    rig.send_candidates(1);
    ASSERT_EQ(rig.heard.size(), 2U);
    EXPECT_EQ(rig.heard[1].seq, 1);
    EXPECT_EQ(rig.heard[1].num_posts, 0);
    EXPECT_EQ(rig.counter("frames_without_kinematics"), 0.0);
}

TEST(UprightDetectionModule, GoesOnWithoutKinematics) {
    Rig rig;
    for (int seq = 0; seq < 60; ++seq) rig.send_candidates(seq);
    EXPECT_GE(rig.heard.size(), 50U) << "of 60 frames in two seconds";
    rig.module.reset();
    ASSERT_EQ(rig.heard.size(), 60U) << "what waits is answered at the end";
    for (int seq = 0; seq < 60; ++seq) EXPECT_EQ(rig.heard[static_cast<std::size_t>(seq)].seq, seq);
    EXPECT_EQ(rig.counter("frames_without_kinematics"), 60.0);
}

/// Two edges that run straight down, as of a post 10 cm thick and 1.7 m away that ends above the ground.
Candidates hung_up() {
    Candidates c;
    c.width = 640;
    c.height = 480;
    for (int y = 2; y < 200; y += 4) {
        c.segments.push_back({Orientation::horizontal, y, 300, 332});
        c.left_edges.emplace_back(299.5, y);
        c.right_edges.emplace_back(332.5, y);
    }
    return c;
}

TEST(UprightDetectionModule, KnowsWhereTheGroundIsByTheKinematicsOfTheFrame) {
    Rig rig;
    rig.send_kinematics(0);
    publish(rig.mouth, channels::candidates, to_message(hung_up(), Rig::time_of(0), 0, Intrinsics{}));
    rig.hub.run_until_idle();
    ASSERT_EQ(rig.heard.size(), 1U);
    EXPECT_EQ(rig.heard[0].num_posts, 0);

    UprightDetectionModule::Parameters parameters;
    parameters.timing.wait = 0.0;
    Rig blind(parameters);
    publish(blind.mouth, channels::candidates, to_message(hung_up(), Rig::time_of(0), 0, Intrinsics{}));
    blind.hub.run_until_idle();
    ASSERT_EQ(blind.heard.size(), 1U);
    ASSERT_EQ(blind.heard[0].num_posts, 1);
    EXPECT_NEAR(blind.heard[0].posts[0].distance_m, 0.05 / std::sin(0.5 * 33.0 / 554.26), 0.02);
}

TEST(UprightDetectionModule, RefusesAFieldThatIsNotThere) {
    UprightDetectionModule::Parameters parameters;
    parameters.field = "/no/such/field.yaml";
    EXPECT_THROW(Rig{parameters}, ConfigurationError);
}

TEST(UprightDetectionModule, DocumentsEveryParameterInItsFile) {
    const auto folder = std::filesystem::path(GOALMOUTH_SOURCE_DIR) / "config" / "modules";
    const auto loaded = list_parameters(
        load_parameters<UprightDetectionModule::Parameters>(folder / "detection_upright.yaml"));
    const auto defaults = list_parameters<UprightDetectionModule::Parameters>();
    ASSERT_EQ(loaded.size(), defaults.size());
    for (std::size_t i = 0; i < loaded.size(); ++i)
        EXPECT_EQ(loaded[i].value, defaults[i].value) << loaded[i].key;
}

}  // namespace
}  // namespace goalmouth
