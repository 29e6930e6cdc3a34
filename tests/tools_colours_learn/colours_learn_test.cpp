#include "core/conversion/intrinsics.h"
#include "core/imaging/colour_table_file.h"
#include "core/imaging/image_file.h"
#include "core/messaging/channels.h"
#include "core/messaging/image_output.h"
#include "core/messaging/log_bus.h"
#include "core/messaging/typed.h"
#include "tests/core/colour_learning/drawn_pitch.h"
#include "tests/support/data.h"
#include "tests/support/files.h"
#include "tests/support/refusal.h"
#include "tests/support/run_verb.h"
#include "tools/colours/colours.h"
#include "tools/colours/learning_pictures.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ColoursLearn : public testing::Test {
  protected:
    /// Runs `goalmouth colours learn ARGUMENTS…`.
    static int learn(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"colours", "learn"});
        const auto add = [](CLI::App& app, Action& action) {
            add_colours_learn(*add_colours_verb(app, action), action);
        };
        return test::run_verb(add, std::move(arguments));
    }
    static std::string error_of(const std::vector<std::string>& arguments) {
        return test::message_of([&] { learn(arguments); });
    }
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    std::string write(const std::string& name, const std::string& content) const {
        test::write_text(path(name), content);
        return path(name);
    }
    /// A folder of drawn pictures.
    std::string pictures(unsigned count) const {
        fs::create_directories(path("pitch"));
        for (unsigned n = 0; n < count; ++n)
            cv::imwrite(path("pitch/" + std::to_string(n) + ".png"),
                        bgr_from_yuyv(test::draw_pitch({}, n).image.view()));
        return path("pitch");
    }
    /// A log with the drawn pictures as a tap records them.
    std::string log(unsigned count) const {
        LogBus bus({.input = {}, .output = path("pitch.lcmlog")});
        for (unsigned n = 0; n < count; ++n) {
            FrameInfo info;
            info.utime = 1'000'000 + 100'000 * std::int64_t{n};
            info.seq = n;
            info.intrinsics = to_message(Intrinsics{});
            bus.set_time(info.utime);
            publish(bus, channels::image_tap,
                    self_contained_yuyv(info, "c", test::draw_pitch({}, n).image.view()));
        }
        return path("pitch.lcmlog");
    }
    test::TemporaryFolder folder_;
};

TEST_F(ColoursLearn, WritesTheTableItsOriginAndTheReport) {
    ASSERT_EQ(learn({pictures(4), "-o", path("t.gmct"), "--bits", "7", "--report", path("report")}), 0);
    const ColourTable table = load_colour_table(path("t.gmct"));
    EXPECT_EQ(table.bits(), 7);
    EXPECT_EQ(table.name(), "t");
    ASSERT_EQ(table.provenance().size(), 3U);
    EXPECT_THAT(table.provenance()[1], HasSubstr("without labels from 4 pictures (0.png … 3.png)"));
    EXPECT_THAT(table.provenance()[2], HasSubstr("goal"));
    for (const char* file : {"contact_sheet.png", "clusters.png", "table.png"})
        EXPECT_FALSE(cv::imread(path("report") + "/" + file).empty()) << file;
    EXPECT_TRUE(fs::exists(path("report/index.html")));
}

/// The picture of the samples shows shares of what was learnt from, whatever size the pictures have.
TEST_F(ColoursLearn, TheReportCountsTheSamplesOfLargePicturesToo) {
    pictures(4);
    fs::create_directories(path("large"));
    for (unsigned n = 0; n < 4; ++n) {
        const std::string name = std::to_string(n) + ".png";
        cv::Mat twice;
        cv::resize(cv::imread(path("pitch/" + name)), twice, {}, 2.0, 2.0, cv::INTER_NEAREST);
        cv::imwrite(path("large/" + name), twice);
    }
    ASSERT_EQ(learn({path("pitch"), "-o", path("t.gmct"), "--report", path("of_small")}), 0);
    ASSERT_EQ(learn({path("large"), "-o", path("t.gmct"), "--report", path("of_large")}), 0);
    const cv::Mat small = cv::imread(path("of_small/clusters.png"));
    const cv::Mat large = cv::imread(path("of_large/clusters.png"));
    ASSERT_EQ(small.size(), large.size());
    EXPECT_LT(cv::norm(small, large, cv::NORM_L1), 0.02 * cv::norm(small, cv::NORM_L1));
}

TEST_F(ColoursLearn, ALogTeachesWhatItsPicturesTeach) {
    ASSERT_EQ(learn({pictures(3), "-o", path("pictures.gmct")}), 0);
    ASSERT_EQ(learn({log(3), "-o", path("log.gmct")}), 0);
    const ColourTable of_pictures = load_colour_table(path("pictures.gmct"));
    const ColourTable of_log = load_colour_table(path("log.gmct"));
    // PNG files hold BGR, the log what the camera gave: a few colours fall the other way.
    std::size_t different = 0;
    for (std::size_t i = 0; i < of_log.entries().size(); ++i)
        different += of_log.entries()[i] != of_pictures.entries()[i];
    EXPECT_LT(different, of_log.entries().size() / 50);
}

TEST_F(ColoursLearn, ManyPicturesAreThinnedEvenly) {
    const std::vector<NamedPicture> all = learning_pictures({pictures(7)}, {}, 3);
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0].name, "0.png");
    EXPECT_EQ(all[1].name, "2.png");
    EXPECT_EQ(all[2].name, "4.png");
    EXPECT_EQ(learning_pictures({log(5)}, {}, 2).size(), 2U);
}

TEST_F(ColoursLearn, WhatCannotBeLearntFromIsSaidAndTheOldTableStays) {
    write("old.gmct", "the table in force");
    cv::imwrite(path("black.png"), cv::Mat::zeros(120, 160, CV_8UC3));
    EXPECT_THAT(error_of({path("black.png"), "-o", path("old.gmct")}), HasSubstr("shows a field"));
    EXPECT_THAT(error_of({path("none.png"), "-o", path("old.gmct")}), HasSubstr("no such file"));
    EXPECT_THAT(error_of({write("text", "not a log at all"), "-o", path("old.gmct")}),
                HasSubstr("no picture"));
    EXPECT_THAT(error_of({write("a.yuyv", "1234"), "--size", "640", "-o", path("old.gmct")}),
                HasSubstr("--size"));
    EXPECT_THAT(error_of({path("black.png"), "-o", path("no/folder/t.gmct")}), HasSubstr("--output"));
    EXPECT_THAT(error_of({path("black.png"), "--field", path("none.yaml"), "-o", path("old.gmct")}),
                HasSubstr("none.yaml"));
    EXPECT_EQ(read_bytes(path("old.gmct")).size(), std::string("the table in force").size());
}

/// Ten ordinary frames of another robot's pitch: posts get the goal's colour, other things do not.
TEST_F(ColoursLearn, TenRealPicturesWillDo) {
    GOALMOUTH_NEEDS_DATA(data);
    ASSERT_EQ(learn({(data / "nao_uva_2013").string(), "--most", "10", "-o", path("nao.gmct")}), 0);
    EXPECT_GT(class_counts(load_colour_table(path("nao.gmct")))[static_cast<std::size_t>(Colour::goal)], 0U);
}

}  // namespace
}  // namespace goalmouth
