#include "modules/refinement/refinement_module.h"

#include "core/conversion/camera_pose.h"
#include "core/conversion/posts.h"
#include "core/conversion/refinement.h"
#include "core/imaging/jpeg.h"
#include "core/messaging/channels.h"
#include "core/messaging/image_output.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"
#include "tests/support/example_messages.h"
#include "tests/support/post_scene.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

/// What a detector may say of the scene's post: its edges to a pixel or two.
Post seen_post(const PostScene& s = {}) {
    Post post;
    post.left_top = {s.post_left + 0.5, s.post_top};
    post.left_base = {s.post_left - 1.0, s.post_base};
    post.right_top = {s.post_right + 1.0, s.post_top};
    post.right_base = {s.post_right, s.post_base};
    post.width_px = 15.75;
    post.distance_m = 1.8;
    post.bearing_rad = 0.01;
    post.covariance << 0.04, 0, 0, 1e-4;
    post.support_left = post.support_right = 25;
    return post;
}

posts_t posts_of_frame(std::int64_t seq, int count = 1, const PostScene& s = {}) {
    const image_t image = scene_message(seq, s);
    return to_message(std::vector<Post>(static_cast<std::size_t>(count), seen_post(s)), image.utime, seq,
                      from_message(image.intrinsics), "detector");
}

kinematics_t kinematics_of_frame(std::int64_t seq) {
    return kinematics_message(camera_in_body(0.4, 0.0, 0.0), scene_message(seq).utime, seq);
}

/// The module with a camera, a detector and somebody who listens.
struct Rig {
    Rig() {
        Bus& ear = hub.endpoint("ear");
        ear.subscribe(channels::posts_refined, Delivery::every,
                      [this](std::span<const std::uint8_t> m) { bytes.emplace_back(m.begin(), m.end()); });
        subscribe<posts_t>(ear, channels::posts_refined, [this](const posts_t& m) { refined.push_back(m); });
        subscribe<refinement_t>(ear, channels::refinement,
                                [this](const refinement_t& m) { how.push_back(m); });
    }
    void start() { module = std::make_unique<RefinementModule>(context, parameters); }

    void send_live(std::int64_t seq, const PostScene& s = {}) {
        const image_t image = scene_message(seq, s);
        FrameInfo info;
        info.utime = image.utime;
        info.seq = seq;
        info.intrinsics = image.intrinsics;
        output.publish(info, scene_image(s).view());
        hub.run_until_idle();
    }
    template <class Message>
    void send(const char* channel, const Message& message) {
        publish(mouth, channel, message);
        hub.run_until_idle();
    }
    void send_posts(std::int64_t seq, int count = 1) { send(channels::posts, posts_of_frame(seq, count)); }
    void send_kinematics(std::int64_t seq) { send(channels::kinematics, kinematics_of_frame(seq)); }
    double counter(const char* name) const {
        const auto found = status.counters().find(name);
        return found == status.counters().end() ? 0.0 : found->second;
    }
    /// Of the posts answered last.
    std::string reason() const { return how.back().posts.at(0).reason; }
    /// Whether it looked at the pixels, whatever it saw there.
    bool looked() const { return reason() != "no picture" && reason() != "overwritten"; }

    MemoryHub hub;
    Status status;
    ModuleContext context{hub.endpoint("refinement"), status, "refinement", 1, {}};
    RefinementModule::Parameters parameters;
    Bus& mouth = hub.endpoint("mouth");
    ImageOutput output{mouth, channels::image, "front", 3};
    std::vector<std::vector<std::uint8_t>> bytes;
    std::vector<posts_t> refined;
    std::vector<refinement_t> how;
    std::unique_ptr<RefinementModule> module;
};

struct RefinementModuleTest : testing::Test, Rig {};

TEST_F(RefinementModuleTest, AnswersAtOnceWhereFrameAndKinematicsAreThere) {
    start();
    for (int i = 0; i < 5; ++i) {
        send_live(i);
        send_kinematics(i);
        send_posts(i, 2);
        ASSERT_EQ(refined.size(), static_cast<std::size_t>(i + 1));
        ASSERT_EQ(how.size(), refined.size());
        EXPECT_EQ(refined.back().utime, scene_message(i).utime);
        EXPECT_EQ(refined.back().seq, i);
        EXPECT_EQ(refined.back().num_posts, 2);
        EXPECT_EQ(refined.back().detector, "detector refined");
        EXPECT_EQ(how.back().utime, refined.back().utime);
        EXPECT_EQ(how.back().seq, i);
        EXPECT_EQ(how.back().num_posts, 2);
        EXPECT_TRUE(looked()) << reason();
    }
    EXPECT_EQ(status.outputs(), 5);
    EXPECT_EQ(counter("refined") + counter("unrefined"), 10.0);
    EXPECT_EQ(counter("frames_without_kinematics"), 0.0);
}

TEST_F(RefinementModuleTest, SharedMemoryAndMessagesGiveTheSameBytes) {
    start();
    send_kinematics(0);
    send_live(0);
    send_posts(0);
    Rig replay;
    replay.start();
    replay.send(channels::image_tap, scene_message(0));
    replay.send_kinematics(0);
    replay.send_posts(0);
    ASSERT_EQ(bytes.size(), 1U);
    EXPECT_TRUE(looked()) << reason();
    EXPECT_EQ(bytes, replay.bytes);
}

TEST_F(RefinementModuleTest, MeasuresThePostInItsFrame) {
    start();
    image_t image = scene_message(0);
    image.data = lifelike_scene_image().data;
    send_kinematics(0);
    send(channels::image_tap, image);
    send_posts(0);
    ASSERT_EQ(refined.size(), 1U);
    const post_t& post = refined[0].posts[0];
    EXPECT_NE(post.flags & post_t::REFINED, 0) << reason();
    EXPECT_EQ(reason(), "");
    EXPECT_NEAR(post.left_base[0], 149.5, 0.2);
    EXPECT_NEAR(post.right_base[0], 165.5, 0.2);
    EXPECT_LT(post.covariance[0], 0.04 * 0.04);
    EXPECT_GT(how[0].posts[0].rows_left, 50);
    EXPECT_GT(how[0].posts[0].rows_right, 50);
    EXPECT_GE(how[0].posts[0].num_cues, 1);
    EXPECT_EQ(counter("refined"), 1.0);
}

TEST_F(RefinementModuleTest, TakesFramesInSlices) {
    start();
    send_kinematics(0);
    send_posts(0);
    SlicePacer pacer(20'000);
    SlicePacer::Time now;
    pacer.offer(scene_message(0), now);
    while (const auto wait = pacer.next_due(now)) {
        now += *wait;
        send(channels::image_slices, *pacer.due(now));
    }
    ASSERT_EQ(refined.size(), 1U);
    EXPECT_TRUE(looked()) << reason();
}

image_t jpeg_message(std::int64_t seq, const PostScene& s = {}) {
    image_t image = scene_message(seq, s);
    image.encoding = "jpeg";
    image.row_stride = 0;
    image.data = jpeg_from_yuyv(scene_image(s).view(), 95);
    image.size = image.data_size = static_cast<std::int32_t>(image.data.size());
    return image;
}

TEST_F(RefinementModuleTest, TakesJpegsAndKeepsEachItsPixels) {
    PostScene moved;
    moved.post_left += 40;
    moved.post_right += 40;
    start();
    send_kinematics(0);
    send(channels::image_tap, jpeg_message(0));
    send(channels::image_tap, jpeg_message(1, moved));
    send_posts(0);
    Rig alone;
    alone.start();
    alone.send_kinematics(0);
    alone.send(channels::image_tap, jpeg_message(0));
    alone.send_posts(0);
    ASSERT_EQ(bytes.size(), 1U);
    EXPECT_TRUE(looked()) << reason();
    EXPECT_EQ(bytes, alone.bytes);
}

TEST_F(RefinementModuleTest, WaitsForAFrameThatComesAfterItsPosts) {
    start();
    send_kinematics(0);
    send_posts(0);
    EXPECT_TRUE(refined.empty());
    send_live(0);
    ASSERT_EQ(refined.size(), 1U);
    EXPECT_TRUE(looked()) << reason();
}

TEST_F(RefinementModuleTest, WaitsForKinematics) {
    start();
    send_live(0);
    send_posts(0);
    EXPECT_TRUE(refined.empty());
    send_kinematics(0);
    EXPECT_EQ(refined.size(), 1U);
    EXPECT_EQ(counter("frames_without_kinematics"), 0.0);
}

TEST_F(RefinementModuleTest, DoesWithoutKinematics) {
    start();
    for (int i = 0; i < 20; ++i) {
        send_live(i);
        const std::size_t before = refined.size();
        send_posts(i);
        if (i > 12) {
            EXPECT_EQ(refined.size(), before + 1) << i;
        }
    }
    ASSERT_EQ(refined.size(), 20U);
    EXPECT_TRUE(looked()) << reason();
    EXPECT_GE(counter("frames_without_kinematics"), 5.0);
}

TEST_F(RefinementModuleTest, PostsOfALogWithoutPixelsPassThroughAsTheyAre) {
    start();
    for (int i = 0; i < 20; ++i) {
        send_kinematics(i);
        const std::size_t before = refined.size();
        send_posts(i, i % 3);
        if (i > 12) {
            EXPECT_EQ(refined.size(), before + 1) << i;
        }
    }
    ASSERT_EQ(refined.size(), 20U);
    for (int i = 0; i < 20; ++i) {
        posts_t expected = posts_of_frame(i, i % 3);
        expected.detector += " refined";
        EXPECT_EQ(encoded(refined[static_cast<std::size_t>(i)]), encoded(expected));
        for (const refined_post_t& post : how[static_cast<std::size_t>(i)].posts) {
            EXPECT_EQ(post.refined, 0);
            EXPECT_EQ(post.reason, "no picture");
        }
    }
}

TEST_F(RefinementModuleTest, AFrameOvertakenBeforeItsPostsIsNotMeasured) {
    start();
    for (int i = 0; i < 6; ++i) {
        send_live(i);
        send_kinematics(i);
    }
    send_posts(0);
    ASSERT_EQ(refined.size(), 1U);
    EXPECT_EQ(reason(), "overwritten");
    EXPECT_EQ(refined[0].posts[0].flags & post_t::REFINED, 0);
    EXPECT_EQ(counter("frames_overwritten"), 1.0);
    send_posts(5);
    EXPECT_TRUE(looked()) << reason();
}

TEST_F(RefinementModuleTest, AFrameOvertakenBeforeItWasSeenIsNotWaitedFor) {
    start();
    for (int i = 0; i < 6; ++i) {
        FrameInfo info;
        info.utime = scene_message(i).utime;
        info.seq = i;
        info.intrinsics = scene_message(i).intrinsics;
        output.publish(info, scene_image().view());  // descriptors wait on the bus meanwhile
    }
    hub.run_until_idle();
    send_kinematics(0);
    send_posts(0);
    ASSERT_EQ(refined.size(), 1U);
    EXPECT_EQ(reason(), "overwritten");
}

TEST_F(RefinementModuleTest, AFrameThatIsLostDelaysItsPostsAndNoOthersForLong) {
    start();
    for (int i = 0; i < 40; ++i) {
        if (i != 10) send_live(i);
        send_kinematics(i);
        send_posts(i);
    }
    ASSERT_EQ(refined.size(), 40U);
    for (std::size_t i = 0; i < 40; ++i) {
        EXPECT_EQ(refined[i].seq, static_cast<std::int64_t>(i));
        EXPECT_EQ(how[i].posts[0].reason == "no picture", i == 10) << i << how[i].posts[0].reason;
    }
}

TEST_F(RefinementModuleTest, KeepsAsManyFramesAsItIsTold) {
    parameters.frames = 2;
    start();
    for (int i = 0; i < 4; ++i) {
        send(channels::image_tap, scene_message(i));
        send_kinematics(i);
    }
    send_posts(1);
    EXPECT_EQ(reason(), "no picture");
    send_posts(2);
    EXPECT_TRUE(looked()) << reason();
}

TEST_F(RefinementModuleTest, TellsCamerasAndSizesApart) {
    start();
    PostScene large;
    large.width = 640;
    large.height = 480;
    image_t other = scene_message(0, large);
    other.camera = "rear";
    send(channels::image_tap, scene_message(0));
    send(channels::image_tap, other);
    send_kinematics(0);
    send(channels::posts, posts_of_frame(0, 1, large));
    send_posts(0);
    ASSERT_EQ(refined.size(), 2U);
    EXPECT_EQ(refined[0].intrinsics.width, 640);
    EXPECT_EQ(refined[1].intrinsics.width, 320);
    for (const refinement_t& m : how) EXPECT_NE(m.posts[0].reason, "no picture");
    // A frame of that time and number, but of another camera.
    PostScene third = large;
    third.width = 400;
    send(channels::posts, posts_of_frame(0, 1, third));
    EXPECT_EQ(reason(), "no picture");
}

TEST_F(RefinementModuleTest, SameBytesHoweverTheChannelsInterleave) {
    std::vector<std::vector<std::uint8_t>> want;
    std::vector<std::string> order = {"IMAGE_TAP", "KINEMATICS", "POSTS"};
    do {
        Rig rig;
        rig.start();
        for (int i = 0; i < 20; ++i) {
            for (const std::string& channel : order) {
                if (channel == "IMAGE_TAP" && i % 4 != 2) publish(rig.mouth, channel, scene_message(i));
                if (channel == "KINEMATICS") publish(rig.mouth, channel, kinematics_of_frame(i));
                if (channel == "POSTS") publish(rig.mouth, channel, posts_of_frame(i, i % 3));
            }
            if (i % 3 == 0) rig.hub.run_until_idle();
        }
        rig.hub.run_until_idle();
        for (int i = 20; i < 30; ++i) rig.send_kinematics(i);
        ASSERT_EQ(rig.bytes.size(), 20U);
        if (want.empty()) want = rig.bytes;
        EXPECT_EQ(rig.bytes, want);
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST_F(RefinementModuleTest, MalformedMessagesAreSkipped) {
    start();
    const std::vector<std::uint8_t> garbage(50, 0xA5);
    for (const char* channel : {channels::posts, channels::image, channels::image_tap, channels::image_slices,
                                channels::kinematics}) {
        mouth.publish(channel, garbage);
    }
    hub.run_until_idle();
    EXPECT_TRUE(refined.empty());
    EXPECT_EQ(hub.endpoint("refinement").counters().rejected_total(), 5);
    send_live(0);
    send_kinematics(0);
    send_posts(0);
    EXPECT_EQ(refined.size(), 1U);
}

TEST_F(RefinementModuleTest, PostsFarOutsideTheImageAreAnswered) {
    start();
    posts_t posts = posts_of_frame(0, 3);
    for (double* corner : {posts.posts[0].left_top, posts.posts[0].right_base}) {
        corner[0] = 1e12;
        corner[1] = -1e15;
    }
    posts.posts[1].left_base[0] = posts.posts[1].right_base[0] = -500;
    posts.posts[2].width_px = 1e-9;
    send_live(0);
    send_kinematics(0);
    send(channels::posts, posts);
    ASSERT_EQ(refined.size(), 1U);
    EXPECT_EQ(refined[0].num_posts, 3);
    EXPECT_EQ(how.size(), 1U);
}

TEST_F(RefinementModuleTest, AnswersWhatWaitsWhenItEnds) {
    start();
    send_posts(0);
    send_posts(1);
    EXPECT_TRUE(refined.empty());
    module.reset();
    hub.run_until_idle();
    ASSERT_EQ(refined.size(), 2U);
    EXPECT_EQ(refined[1].seq, 1);
    EXPECT_EQ(reason(), "no picture");
}

TEST_F(RefinementModuleTest, AMissingFieldIsAConfigurationError) {
    parameters.field = "/no/such/field.yaml";
    EXPECT_THROW(start(), ConfigurationError);
}

TEST_F(RefinementModuleTest, ShippedConfigurationHoldsTheDefaults) {
    const auto file = std::filesystem::path(GOALMOUTH_SOURCE_DIR) / "config" / "modules" / "refinement.yaml";
    const auto shipped = list_parameters(load_parameters<RefinementModule::Parameters>(file));
    const auto defaults = list_parameters<RefinementModule::Parameters>();
    ASSERT_EQ(shipped.size(), defaults.size());
    for (std::size_t i = 0; i < shipped.size(); ++i)
        EXPECT_EQ(shipped[i].value, defaults[i].value) << shipped[i].key;
}

}  // namespace
}  // namespace goalmouth
