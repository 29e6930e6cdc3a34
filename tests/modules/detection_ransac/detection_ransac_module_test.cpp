#include "modules/detection_ransac/detection_ransac_module.h"

#include "core/conversion/candidates.h"
#include "core/imaging/colour_table_file.h"
#include "core/messaging/channels.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"
#include "modules/extraction/extraction_module.h"
#include "modules/segmentation/segmentation_module.h"
#include "tests/support/data.h"
#include "tests/support/post_scene.h"

#include <memory>
#include <vector>

#include <goalmouth/posts_t.hpp>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

/// A module with what it needs, on a hub.
template <class M>
struct Running {
    Running(MemoryHub& hub, const std::string& name, std::uint64_t seed,
            const typename M::Parameters& parameters)
        : context{hub.endpoint(name), status, name, seed, {}}, module(context, parameters) {}
    Status status;
    ModuleContext context;
    M module;
};

/// Posts of some frames of the scene, from pixels.
std::vector<posts_t> run_chain(std::uint64_t seed, int frames) {
    TemporaryFolder folder;
    SegmentationModule::Parameters segmentation;
    segmentation.colours = (folder.path() / "table.gmct").string();
    save_colour_table(scene_table(), segmentation.colours);

    MemoryHub hub;
    std::vector<posts_t> heard;
    subscribe<posts_t>(hub.endpoint("listener"), channels::posts,
                       [&](const posts_t& m) { heard.push_back(m); });
    Running<SegmentationModule> first(hub, "segmentation", seed, segmentation);
    Running<ExtractionModule> second(hub, "extraction", seed, {});
    Running<RansacDetectionModule> third(hub, "detection", seed, {});
    for (int seq = 0; seq < frames; ++seq) {
        publish(hub.endpoint("camera"), channels::image, scene_message(seq));
        hub.run_until_idle();
    }
    return heard;
}

TEST(RansacDetectionModule, FindsThePostFromPixelsToPosts) {
    const auto heard = run_chain(1, 1);
    ASSERT_EQ(heard.size(), 1U);
    EXPECT_EQ(heard[0].detector, "detection_ransac");
    ASSERT_EQ(heard[0].num_posts, 1);
    const post_t& post = heard[0].posts[0];
    EXPECT_NEAR(post.left_top[0], 149.5, 0.2);
    EXPECT_NEAR(post.right_base[0], 165.5, 0.2);
    EXPECT_NEAR(post.left_base[1], 140, 4);
    EXPECT_NEAR(post.distance_m, 0.1 * 554.26 / 2 / 16, 0.05);
    EXPECT_EQ(post.flags, 0);
}

TEST(RansacDetectionModule, SameSeedSameBytes) {
    const auto bytes = [](const posts_t& m) {
        std::vector<std::uint8_t> encoded(static_cast<std::size_t>(m.getEncodedSize()));
        m.encode(encoded.data(), 0, static_cast<int>(encoded.size()));
        return encoded;
    };
    const auto a = run_chain(7, 3);
    const auto b = run_chain(7, 3);
    ASSERT_EQ(a.size(), 3U);
    ASSERT_EQ(b.size(), 3U);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(bytes(a[i]), bytes(b[i]));
}

TEST(RansacDetectionModule, PublishesThatThereIsNothing) {
    MemoryHub hub;
    std::vector<posts_t> heard;
    subscribe<posts_t>(hub.endpoint("listener"), channels::posts,
                       [&](const posts_t& m) { heard.push_back(m); });
    Running<RansacDetectionModule> module(hub, "detection", 1, {});
    publish(hub.endpoint("extraction"), channels::candidates, to_message(Candidates{}, 5, 6, Intrinsics{}));
    hub.run_until_idle();
    ASSERT_EQ(heard.size(), 1U);
    EXPECT_EQ(heard[0].num_posts, 0);
    EXPECT_EQ(heard[0].seq, 6);
    EXPECT_EQ(module.status.outputs(), 1);
}

TEST(RansacDetectionModule, TakesTheDiameterFromTheField) {
    MemoryHub hub;
    RansacDetectionModule::Parameters parameters;
    parameters.field = "/no/such/field.yaml";
    EXPECT_THROW(Running<RansacDetectionModule>(hub, "detection", 1, parameters), ConfigurationError);
}

TEST(RansacDetectionModule, DocumentsEveryParameterInItsFiles) {
    const auto folder = std::filesystem::path(GOALMOUTH_SOURCE_DIR) / "config" / "modules";
    const auto loaded =
        list_parameters(load_parameters<RansacDetectionModule::Parameters>(folder / "detection_ransac.yaml"));
    const auto defaults = list_parameters<RansacDetectionModule::Parameters>();
    for (std::size_t i = 0; i < loaded.size(); ++i)
        EXPECT_EQ(loaded[i].value, defaults[i].value) << loaded[i].key;
    EXPECT_NO_THROW(
        load_parameters<RansacDetectionModule::Parameters>(folder / "detection_ransac_tuned.yaml"));
}

}  // namespace
}  // namespace goalmouth
