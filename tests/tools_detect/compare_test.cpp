#include "core/imaging/colour_picture.h"
#include "core/imaging/colour_table_file.h"
#include "core/imaging/conversion.h"
#include "core/process/configuration.h"
#include "tests/support/data.h"
#include "tests/support/post_scene.h"
#include "tests/support/run_verb.h"
#include "tools/goalmouth/verbs.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

struct Compare : testing::Test {
    Compare() {
        save_colour_table(scene_table(), path("table.gmct"));
        cv::imwrite(path("scene.png"), bgr_from_yuyv(scene_image().view()));
    }
    std::string path(const std::string& name) const { return (folder.path() / name).string(); }

    cv::Mat run(const std::string& image, std::vector<std::string> ways) const {
        std::vector<std::string> arguments = {"compare",       path(image), "-o",
                                              path("out.png"), "--width",   "320"};
        for (std::string& way : ways) arguments.insert(arguments.end(), {"--way", std::move(way)});
        EXPECT_EQ(test::run_verb(add_compare_verb, std::move(arguments)), 0);
        return cv::imread(path("out.png"));
    }

    TemporaryFolder folder;
};

TEST_F(Compare, PutsAPanelForEachWayBesideTheOthers) {
    const cv::Mat both = run("scene.png", {"a=ransac," + path("table.gmct"), "b=edges"});
    const cv::Mat one = run("scene.png", {"a=ransac," + path("table.gmct")});
    ASSERT_EQ(one.cols, 320);
    ASSERT_GT(both.cols, 640);
    EXPECT_EQ(both.rows, one.rows);
    EXPECT_EQ(cv::norm(both.colRange(0, 320), one, cv::NORM_INF), 0.0);
    const int head = one.rows - 240;
    EXPECT_EQ(one.at<cv::Vec3b>(head + 160, 40), display_colour(Colour::field));
}

TEST_F(Compare, ShowsNothingOfThePictureItself) {
    // Another wall of no class, a shade of green as good as the first: the drawing stays the same.
    YuyvImage other = scene_image();
    for (int y = 0; y < 15; ++y)
        for (int x = 0; x < other.width; ++x)
            other.data[static_cast<std::size_t>(y * other.stride() + 2 * x)] = 75;
    cv::imwrite(path("other.png"), bgr_from_yuyv(other.view()));
    ASSERT_NE(cv::norm(cv::imread(path("scene.png")), cv::imread(path("other.png")), cv::NORM_INF), 0.0);
    const std::vector<std::string> ways = {"a=ransac," + path("table.gmct")};
    const cv::Mat drawn = run("scene.png", ways);
    EXPECT_EQ(cv::norm(drawn, run("other.png", ways), cv::NORM_INF), 0.0);
}

TEST_F(Compare, RefusesWhatIsNoWay) {
    for (const char* way : {"ransac", "=ransac", "a=", "a=nosuch", "a=ransac,nosuch.gmct"})
        EXPECT_THROW(run("scene.png", {way}), ConfigurationError) << way;
}

}  // namespace
}  // namespace goalmouth
