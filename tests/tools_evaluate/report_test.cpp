#include "tests/support/evaluate_command.h"
#include "tests/support/well_formed.h"

#include <filesystem>
#include <set>
#include <string>

#include <gmock/gmock.h>

namespace goalmouth {
namespace {

using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

struct PaperPage : test::EvaluateCommand {
    void SetUp() override { frames_per_cell = "1"; }
    std::string page(const std::string& name) const { return text(name + "/index.html"); }
    std::set<std::string> files(const std::string& name) const {
        std::set<std::string> names;
        for (const auto& entry : fs::recursive_directory_iterator(path(name)))
            if (entry.is_regular_file()) names.insert(entry.path().filename().string());
        return names;
    }
};

/// Without the command, the one thing that a merged run has of its own.
std::string without_command(std::string html) {
    const auto from = html.find("<h2 id=\"how-it-was-made\">");
    const auto to = html.find("</pre>", from);
    return html.erase(from, to - from);
}

TEST_F(PaperPage, HoldsEveryDetectorSceneFigureAndFailure) {
    ASSERT_EQ(small_paper("a.json", {"--scene", "flat,match", "--detectors", "histogram,ransac,tuned",
                                     "--report", path("page")}),
              0);
    const std::string html = page("page");
    EXPECT_EQ(test::fault_in_markup(html), "");
    EXPECT_EQ(test::repeated_id(html), "");
    EXPECT_LT(html.size(), 15'000'000U);

    std::set<std::string> expected = {"index.html"};
    for (const std::string scene : {"flat", "match"}) {
        EXPECT_THAT(html, HasSubstr("<summary>Scene " + scene + "</summary>"));
        for (const std::string detector : {"histogram", "ransac", "tuned"}) {
            EXPECT_THAT(html, HasSubstr("aria-label=\"" + detector + ", scene " + scene + ", 160x120\""));
            EXPECT_THAT(html,
                        HasSubstr("<th scope=\"row\">" + scene + "</th><td>" + detector + "</td><td class"));
            for (const std::string kind : {"detection-", "distance-", "bound-"})
                for (const std::string type : {".svg", ".png"})
                    expected.insert(kind + detector + "-" + scene + type);
        }
    }
    EXPECT_EQ(files("page"), expected);
    EXPECT_THAT(html, HasSubstr("<td>histogram</td><td class=\"n\">–</td><td class=\"n\">–</td>"))
        << "the paper's row";
    EXPECT_THAT(html, HasSubstr("in the paper it was 9.4 times RANSAC"));
    EXPECT_EQ(test::count(html, "<svg "), 18U);

    const auto failures = html.find("<h2 id=\"worst-failures\">");
    EXPECT_GE(test::count(html.substr(failures), "src=\"data:image/jpeg;base64,"), 12U);
    for (const char* title : {"histogram, scene flat", "histogram, scene match", "ransac, scene match"})
        EXPECT_THAT(html.substr(failures), HasSubstr(std::string("<h3>") + title + "</h3>"));
    EXPECT_THAT(without_command(html), Not(HasSubstr(folder.path().string())));
}

TEST_F(PaperPage, IsTheSameFromShardsAsFromTheWhole) {
    ASSERT_EQ(small_paper("a.json", {"--scene", "match", "--report", path("whole")}), 0);
    for (const std::string part : {"1", "2"})
        ASSERT_EQ(small_paper(part + ".json", {"--scene", "match", "--shard", part + "/2"}), 0);
    ASSERT_EQ(run({"merge", path("2.json"), path("1.json"), "--report", path("merged")}), 0);
    EXPECT_TRUE(without_command(page("whole")) == without_command(page("merged")));
    EXPECT_EQ(files("whole"), files("merged"));
}

TEST_F(PaperPage, SaysWhatIsMissing) {
    ASSERT_EQ(small_paper("1.json", {"--shard", "1/2", "--report", path("part")}), 0);
    EXPECT_THAT(page("part"), HasSubstr("This is shard 1/2"));
    ASSERT_EQ(run({"merge", path("1.json"), "--partial", "--report", path("merged")}), 0);
    EXPECT_THAT(page("merged"), HasSubstr("Not the whole: 9 frames"));
    EXPECT_EQ(test::fault_in_markup(page("merged")), "");
}

TEST_F(PaperPage, GoesWithoutPicturesWhereSettingsAreOthersByNow) {
    ASSERT_EQ(small_paper("a.json", {"--detectors", "ransac"}), 0);
    auto j = json("a.json");
    j["settings"]["detectors"]["ransac"]["detection"]["ransac.attempts"] = 49;
    write("a.json", j.dump());
    ASSERT_EQ(run({"merge", path("a.json"), "--report", path("page")}), 0);
    EXPECT_THAT(page("page"), HasSubstr("No pictures"));
    EXPECT_THAT(page("page"), Not(HasSubstr("data:image/jpeg")));
}

}  // namespace
}  // namespace goalmouth
