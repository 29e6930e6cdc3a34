#include "modules/detection_histogram/detection_histogram_module.h"

#include "core/conversion/candidates.h"
#include "core/messaging/channels.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"

#include <vector>

#include <goalmouth/posts_t.hpp>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

std::vector<posts_t> detect(const Candidates& candidates) {
    MemoryHub hub;
    Status status;
    ModuleContext context{hub.endpoint("detection"), status, "detection", 1, {}};
    HistogramDetectionModule module(context, {});
    std::vector<posts_t> heard;
    subscribe<posts_t>(hub.endpoint("listener"), channels::posts,
                       [&](const posts_t& m) { heard.push_back(m); });
    publish(hub.endpoint("extraction"), channels::candidates, to_message(candidates, 5, 6, Intrinsics{}));
    hub.run_until_idle();
    EXPECT_EQ(status.outputs(), 1);
    return heard;
}

TEST(HistogramDetectionModule, FindsAPost) {
    Candidates c;
    for (int y = 100; y <= 300; y += 4) c.segments.push_back({Orientation::horizontal, y, 310, 329});
    const auto heard = detect(c);
    ASSERT_EQ(heard.size(), 1U);
    EXPECT_EQ(heard[0].detector, "detection_histogram");
    EXPECT_EQ(heard[0].utime, 5);
    ASSERT_EQ(heard[0].num_posts, 1);
    EXPECT_NEAR(heard[0].posts[0].width_px, 20.0, 1e-9);
}

TEST(HistogramDetectionModule, PublishesThatThereIsNothing) {
    const auto heard = detect({});
    ASSERT_EQ(heard.size(), 1U);
    EXPECT_EQ(heard[0].num_posts, 0);
}

TEST(HistogramDetectionModule, DocumentsEveryParameterInItsFile) {
    const auto file =
        std::filesystem::path(GOALMOUTH_SOURCE_DIR) / "config" / "modules" / "detection_histogram.yaml";
    const auto loaded = list_parameters(load_parameters<HistogramDetectionModule::Parameters>(file));
    const auto defaults = list_parameters<HistogramDetectionModule::Parameters>();
    for (std::size_t i = 0; i < loaded.size(); ++i)
        EXPECT_EQ(loaded[i].value, defaults[i].value) << loaded[i].key;
}

}  // namespace
}  // namespace goalmouth
