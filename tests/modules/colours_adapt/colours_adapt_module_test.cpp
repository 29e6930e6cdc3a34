#include "modules/colours_adapt/colours_adapt_module.h"

#include "core/colour_learning/colour_learner.h"
#include "core/conversion/intrinsics.h"
#include "core/conversion/posts.h"
#include "core/imaging/colour_table_file.h"
#include "core/imaging/image_file.h"
#include "core/imaging/shrink.h"
#include "core/messaging/channels.h"
#include "core/messaging/image_output.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"
#include "modules/detection_ransac/detection_ransac_module.h"
#include "modules/extraction/extraction_module.h"
#include "modules/segmentation/segmentation_module.h"
#include "tests/core/colour_learning/drawn_pitch.h"
#include "tests/support/data.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <goalmouth/colour_gains_t.hpp>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr unsigned views = 6;

/// Six views of a pitch, and a table learnt from them as they are.
struct Venue {
    std::vector<cv::Mat> bgr;
    std::vector<std::vector<cv::Rect>> posts;
    ColourTable table;
};

const Venue& venue() {
    static const Venue made = [] {
        Venue v;
        std::vector<YuyvImage> images;
        for (unsigned n = 0; n < views; ++n) {
            // Without things in the posts' colour before them: what is lost is lost to the light.
            test::DrawnPitch pitch;
            pitch.things = 0;
            test::DrawnPicture picture = test::draw_pitch(pitch, n);
            v.bgr.push_back(bgr_from_yuyv(picture.image.view()));
            v.posts.push_back(picture.posts);
            images.push_back(std::move(picture.image));
        }
        v.table = learn_without_labels(images, GoalPaint::yellow, 6, "venue").table;
        return v;
    }();
    return made;
}

/// The picture in another light; what is too bright clips.
YuyvImage lit(const cv::Mat& bgr, const test::Light& light) {
    cv::Mat out;
    cv::multiply(bgr, cv::Scalar(light.blue, light.green, light.red), out);
    return yuyv_from_bgr(out);
}

/// The light of `a` after a share of the way to `b`, by equal factors.
test::Light between(const test::Light& b, double share) {
    return {std::pow(b.red, share), std::pow(b.green, share), std::pow(b.blue, share)};
}

/// Segmentation to detection on a bus in memory, with or without adaptation.
class Robot {
  public:
    /// `late`: colours_adapt hears of posts only two frames later.
    Robot(const std::string& table, bool adapts, ColoursAdaptModule::Parameters parameters = {},
          bool late = false) {
        SegmentationModule::Parameters segmentation;
        segmentation.colours = table;
        segmentation_.emplace(context("segmentation"), segmentation);
        extraction_.emplace(context("extraction"), ExtractionModule::Parameters{});
        detection_.emplace(context("detection"), RansacDetectionModule::Parameters{});
        parameters.colours = table;
        ModuleContext& adapt = context("adapt");
        if (late) {
            adapt.channels[channels::posts] = "POSTS_LATE";
            subscribe<posts_t>(hub_.endpoint("late"), channels::posts,
                               [this](const posts_t& m) { on_their_way_.push_back(m); });
        }
        if (adapts) adapt_.emplace(adapt, parameters);
        subscribe<posts_t>(hub_.endpoint("listener"), channels::posts,
                           [this](const posts_t& m) { posts_ = from_message(m); });
        subscribe<colour_gains_t>(hub_.endpoint("listener"), channels::colour_gains,
                                  [this](const colour_gains_t& m) { said.push_back(m); });
    }

    /// A tenth of a second later.
    const std::vector<Post>& sees(const YuyvImage& image) {
        FrameInfo info;
        info.seq = seq_++;
        info.utime = 1'000'000 + 100'000 * info.seq;
        info.intrinsics = to_message(Intrinsics{});
        posts_.clear();
        publish(hub_.endpoint("camera"), channels::image, self_contained_yuyv(info, "c", image.view()));
        hub_.run_until_idle();
        for (; on_their_way_.size() > 2; on_their_way_.pop_front())
            publish(hub_.endpoint("late"), "POSTS_LATE", on_their_way_.front());
        hub_.run_until_idle();
        return posts_;
    }

    /// A replay begins again.
    void begin_again() { seq_ = 0; }

    std::vector<colour_gains_t> said;
    /// What colours_adapt counted.
    double counted(const std::string& what) const {
        const auto found = statuses_.back()->counters().find(what);
        return found == statuses_.back()->counters().end() ? 0.0 : found->second;
    }

  private:
    ModuleContext& context(const std::string& name) {
        contexts_.push_back(std::make_unique<ModuleContext>(ModuleContext{
            hub_.endpoint(name), *statuses_.emplace_back(std::make_unique<Status>()), name, 1, {}}));
        return *contexts_.back();
    }

    MemoryHub hub_;
    std::vector<std::unique_ptr<Status>> statuses_;
    std::vector<std::unique_ptr<ModuleContext>> contexts_;
    std::optional<SegmentationModule> segmentation_;
    std::optional<ExtractionModule> extraction_;
    std::optional<RansacDetectionModule> detection_;
    std::optional<ColoursAdaptModule> adapt_;
    std::vector<Post> posts_;
    std::deque<posts_t> on_their_way_;
    std::int64_t seq_ = 0;
};

/// Both edges within a quarter of the width, at half of the height.
bool found(double true_left, double true_right, const std::vector<Post>& posts) {
    const double allowed = 0.25 * (true_right - true_left);
    return std::any_of(posts.begin(), posts.end(), [&](const Post& post) {
        const double left = 0.5 * (post.left_top + post.left_base).x();
        const double right = 0.5 * (post.right_top + post.right_base).x();
        return std::abs(left - true_left) <= allowed && std::abs(right - true_right) <= allowed;
    });
}

class ColoursAdapt : public testing::Test {
  protected:
    ColoursAdapt() { save_colour_table(venue().table, table()); }
    std::string table() const { return (folder_.path() / "t.gmct").string(); }

    /// Light changes to `light` within eight seconds.
    static void change(Robot& robot, const test::Light& light) {
        for (int i = 0; i < 15; ++i) robot.sees(lit(venue().bgr[static_cast<std::size_t>(i) % views], {}));
        for (int i = 0; i < 110; ++i) {
            const double share = std::min(1.0, i / 80.0);
            robot.sees(lit(venue().bgr[static_cast<std::size_t>(i) % views], between(light, share)));
        }
    }
    /// The share of the posts found in all views in that light.
    static double found_in(Robot& robot, const test::Light& light) {
        double all = 0.0, right = 0.0;
        for (std::size_t n = 0; n < views; ++n) {
            const std::vector<Post>& posts = robot.sees(lit(venue().bgr[n], light));
            for (const cv::Rect& truth : venue().posts[n]) {
                all += 1.0;
                right += found(truth.x - 0.5, truth.br().x - 0.5, posts);
            }
        }
        return right / all;
    }
    test::TemporaryFolder folder_;
};

/// Factors on levels: brightness × 0.3 and × 3 and colour temperatures as a camera of gamma 2.2 codes them.
const std::vector<std::pair<std::string, test::Light>> lights = {
    {"x0.3", {0.58, 0.58, 0.58}}, {"x0.5", {0.73, 0.73, 0.73}},        {"x1", {1.0, 1.0, 1.0}},
    {"x2", {1.37, 1.37, 1.37}},   {"x3", {1.65, 1.65, 1.65}},          {"2700 K", {1.15, 0.95, 0.67}},
    {"7500 K", {0.95, 1.0, 1.1}}, {"x0.3, 2700 K", {0.67, 0.55, 0.39}}};

TEST_F(ColoursAdapt, PostsAreFoundInOtherLight) {
    double with = 0.0, without = 0.0;
    for (const auto& [name, light] : lights) {
        Robot adapting(table(), true);
        Robot fixed(table(), false);
        change(adapting, light);
        const double on = found_in(adapting, light);
        const double off = found_in(fixed, light);
        std::printf("%-14s posts found: %5.1f %% adapting, %5.1f %% without\n", name.c_str(), 100 * on,
                    100 * off);
        with += on / static_cast<double>(lights.size());
        without += off / static_cast<double>(lights.size());
    }
    std::printf("all            posts found: %5.1f %% adapting, %5.1f %% without\n", 100 * with,
                100 * without);
    EXPECT_GE(with, 0.97);
    EXPECT_LT(without, with);
}

TEST_F(ColoursAdapt, TheGainsAreThoseOfTheLight) {
    Robot robot(table(), true);
    change(robot, {0.7, 0.6, 0.5});
    ASSERT_FALSE(robot.said.empty());
    EXPECT_NEAR(robot.said.back().red, 0.7, 0.05);
    EXPECT_NEAR(robot.said.back().green, 0.6, 0.03);
    EXPECT_NEAR(robot.said.back().blue, 0.5, 0.05);
    for (const colour_gains_t& m : robot.said) EXPECT_EQ(m.from_utime, m.utime + 300'000);
    for (std::size_t i = 1; i < robot.said.size(); ++i)
        EXPECT_GE(robot.said[i].utime - robot.said[i - 1].utime, 500'000);
}

TEST_F(ColoursAdapt, SaysWhatFieldAndPostsLookedLikeBefore) {
    Robot robot(table(), true);
    for (int round = 0; round < 3; ++round)
        for (const cv::Mat& view : venue().bgr) robot.sees(lit(view, {}));
    change(robot, {0.7, 0.6, 0.5});
    ASSERT_FALSE(robot.said.empty());
    const colour_gains_t& m = robot.said.back();
    const cv::Rect post = venue().posts[0].front();
    const cv::Scalar drawn = cv::mean(venue().bgr[0](
        cv::Rect(post.x + post.width / 4, post.y + post.height / 4, post.width / 2, post.height / 2)));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(m.goal[c], drawn[2 - c], 0.2 * drawn[2 - c] + 8.0) << c;
    EXPECT_GT(m.field[1], m.field[0]);
    EXPECT_GT(m.field[1], m.field[2]);
}

TEST_F(ColoursAdapt, WhatLeavesNothingOfThePostsIsNotSaid) {
    ColoursAdaptModule::Parameters parameters;
    parameters.least_kept = 1.0;  // which no table adapted to another light reaches
    parameters.goal.least_posts = 10000;
    parameters.goal.posts = 10000;
    Robot robot(table(), true, parameters);
    change(robot, {0.6, 0.5, 0.4});
    EXPECT_TRUE(robot.said.empty());
    EXPECT_GT(robot.counted("posts_not_told"), 0.0);
}

TEST_F(ColoursAdapt, SaysWhatPostsLookLikeOnceThatIsKnown) {
    ColoursAdaptModule::Parameters parameters;
    parameters.goal.least_posts = parameters.goal.posts = 260;  // known when the light no longer changes
    Robot robot(table(), true, parameters);
    change(robot, {0.8, 0.75, 0.7});
    ASSERT_FALSE(robot.said.empty());
    ASSERT_EQ(robot.said.back().goal[0], 0.0);
    for (int round = 0; round < 40; ++round)
        for (const cv::Mat& view : venue().bgr) robot.sees(lit(view, {0.8, 0.75, 0.7}));
    EXPECT_GT(robot.said.back().goal[0], 0.0);
}

TEST_F(ColoursAdapt, SaysWhatCannotBe) {
    ColoursAdaptModule::Parameters parameters;
    parameters.goal.least_posts = 41;
    EXPECT_THROW(Robot(table(), true, parameters), ConfigurationError);
}

TEST_F(ColoursAdapt, TheSameFramesGiveTheSameMessages) {
    // However long posts are on their way.
    Robot one(table(), true), two(table(), true), three(table(), true, {}, true);
    for (Robot* robot : {&one, &two, &three}) change(*robot, {0.8, 0.7, 0.6});
    const auto bytes = [](const colour_gains_t& m) {
        std::vector<std::uint8_t> encoded(static_cast<std::size_t>(m.getEncodedSize()));
        m.encode(encoded.data(), 0, static_cast<int>(encoded.size()));
        return encoded;
    };
    ASSERT_GT(one.said.back().goal[0], 0.0);
    for (const Robot* other : {&two, &three}) {
        ASSERT_EQ(one.said.size(), other->said.size());
        for (std::size_t i = 0; i < one.said.size(); ++i)
            EXPECT_EQ(bytes(one.said[i]), bytes(other->said[i])) << i;
    }
}

TEST_F(ColoursAdapt, AViewWithoutFieldChangesNothing) {
    Robot robot(table(), true);
    for (int i = 0; i < 15; ++i) robot.sees(lit(venue().bgr[static_cast<std::size_t>(i) % views], {}));
    for (const cv::Scalar& colour : {cv::Scalar(150, 158, 160), cv::Scalar(0, 0, 0), cv::Scalar(30, 90, 170),
                                     cv::Scalar(255, 255, 255), cv::Scalar(40, 190, 225)}) {
        const YuyvImage wall = yuyv_from_bgr(cv::Mat(480, 640, CV_8UC3, colour));
        for (int i = 0; i < 60; ++i) robot.sees(wall);
    }
    EXPECT_TRUE(robot.said.empty());
    EXPECT_EQ(robot.sees(lit(venue().bgr[0], {})).size(), venue().posts[0].size());
}

TEST_F(ColoursAdapt, SaysAgainWhatHoldsForThoseWhoMissedIt) {
    Robot robot(table(), true);
    change(robot, {0.7, 0.7, 0.7});
    for (int i = 0; i < 30; ++i) robot.sees(lit(venue().bgr[0], {0.7, 0.7, 0.7}));
    const std::size_t before = robot.said.size();
    ASSERT_GT(before, 0U);
    // Also where nothing can be seen of the field.
    const YuyvImage wall = yuyv_from_bgr(cv::Mat(480, 640, CV_8UC3, cv::Scalar(150, 158, 160)));
    for (int i = 0; i < 50; ++i) robot.sees(wall);
    ASSERT_GE(robot.said.size(), before + 2);
    EXPECT_EQ(robot.said.back().red, robot.said[before - 1].red);
}

TEST_F(ColoursAdapt, BeginsAnewWhereTimeRunsBack) {
    Robot robot(table(), true), fresh(table(), true);
    change(robot, {0.7, 0.7, 0.7});
    robot.begin_again();
    robot.said.clear();
    change(robot, {0.8, 0.7, 0.6});
    change(fresh, {0.8, 0.7, 0.6});
    ASSERT_EQ(robot.said.size(), fresh.said.size());
    for (std::size_t i = 0; i < robot.said.size(); ++i) {
        EXPECT_EQ(robot.said[i].utime, fresh.said[i].utime);
        EXPECT_EQ(robot.said[i].red, fresh.said[i].red);
    }
}

TEST_F(ColoursAdapt, FrozenItSaysNothing) {
    ColoursAdaptModule::Parameters parameters;
    parameters.frozen = true;
    Robot robot(table(), true, parameters);
    change(robot, {0.7, 0.7, 0.7});
    EXPECT_TRUE(robot.said.empty());
}

TEST_F(ColoursAdapt, WhatIsSoonOverIsNotLight) {
    Robot robot(table(), true);
    for (int i = 0; i < 15; ++i) robot.sees(lit(venue().bgr[static_cast<std::size_t>(i) % views], {}));
    for (int round = 0; round < 5; ++round) {
        for (int i = 0; i < 10; ++i)
            robot.sees(lit(venue().bgr[static_cast<std::size_t>(i) % views], {1.6, 1.6, 1.6}));
        for (int i = 0; i < 5; ++i) robot.sees(lit(venue().bgr[static_cast<std::size_t>(i) % views], {}));
    }
    EXPECT_TRUE(robot.said.empty());
}

TEST_F(ColoursAdapt, ALampThatWasSwitchedIsFollowed) {
    for (const test::Light& light :
         {test::Light{1.6, 1.6, 1.6}, test::Light{0.5, 0.5, 0.5}, test::Light{0.3, 0.25, 0.2}}) {
        Robot robot(table(), true);
        for (int i = 0; i < 15; ++i) robot.sees(lit(venue().bgr[static_cast<std::size_t>(i) % views], {}));
        for (int i = 0; i < 50; ++i) robot.sees(lit(venue().bgr[static_cast<std::size_t>(i) % views], light));
        EXPECT_GE(found_in(robot, light), 0.9) << light.green;
    }
}

/// Real pictures, made darker, brighter, warmer and colder by degrees; three show no field at all. Found are
/// posts that are found in the pictures as they are, within a quarter of their width.
TEST(ColoursAdaptRealPictures, PostsAreFoundInOtherLight) {
    GOALMOUTH_NEEDS_DATA(data);
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(data / "nao_uva_2013"))
        if (is_image_name(entry.path())) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<cv::Mat> bgr;
    std::vector<YuyvImage> images;
    for (const auto& file : files) {
        images.push_back(shrunk(read_image(file).view(), 2));
        bgr.push_back(bgr_from_yuyv(images.back().view()));
    }
    const test::TemporaryFolder folder;
    const std::string table = (folder.path() / "t.gmct").string();
    save_colour_table(learn_without_labels(images, GoalPaint::yellow, 6, "t").table, table);

    const auto posts_in = [&](Robot& robot, const test::Light& light) {
        std::vector<std::vector<Post>> posts;
        for (const cv::Mat& picture : bgr) posts.push_back(robot.sees(lit(picture, light)));
        return posts;
    };
    double all = 0.0, with = 0.0, without = 0.0;
    for (const auto& [name, light] : lights) {
        Robot adapting(table, true);
        Robot fixed(table, false);
        const auto as_it_was = posts_in(adapting, {});
        for (int round = 1; round <= 3; ++round) posts_in(adapting, between(light, round / 3.0));
        const auto on = posts_in(adapting, light);
        const auto off = posts_in(fixed, light);
        double posts = 0.0, found_on = 0.0, found_off = 0.0;
        for (std::size_t i = 0; i < as_it_was.size(); ++i) {
            for (const Post& post : as_it_was[i]) {
                const double left = 0.5 * (post.left_top + post.left_base).x();
                const double right = 0.5 * (post.right_top + post.right_base).x();
                posts += 1.0;
                found_on += found(left, right, on[i]);
                found_off += found(left, right, off[i]);
            }
        }
        std::printf("%-14s of %g posts found: %g adapting, %g without\n", name.c_str(), posts, found_on,
                    found_off);
        all += posts;
        with += found_on;
        without += found_off;
    }
    EXPECT_GT(all, 8 * 12);
    EXPECT_GE(with, 0.97 * all);
    EXPECT_LT(without, 0.8 * with);
}

}  // namespace
}  // namespace goalmouth
