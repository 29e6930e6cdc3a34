#include "tools/evaluate/report/report_folder.h"

#include "tests/support/data.h"
#include "tests/support/files.h"
#include "tests/support/refusal.h"

#include <set>
#include <stdexcept>
#include <string>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::read_text;
using testing::HasSubstr;

/// Names in a folder, those in folders below as well.
std::set<std::string> names_in(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        names.insert(entry.path().lexically_relative(folder).string());
    return names;
}

/// The process is nobody's while it lives, where it was the superuser's: nothing is closed to that one.
class Unprivileged {
  public:
    Unprivileged() {
        if (superuser_) {
            EXPECT_EQ(::setresuid(65534, 65534, 0), 0);
        }
    }
    ~Unprivileged() {
        if (superuser_) {
            EXPECT_EQ(::setresuid(0, 0, 0), 0);
        }
    }
    Unprivileged(const Unprivileged&) = delete;
    Unprivileged& operator=(const Unprivileged&) = delete;

  private:
    bool superuser_ = ::geteuid() == 0;
};

void make_old_report(const fs::path& folder) {
    fs::create_directories(folder);
    test::write_text(folder / "index.html", "old page");
    test::write_text(folder / "a.svg", "old figure");
    test::write_text(folder / "notes.txt", "mine");
}

TEST(ReportFolder, AppearsWholeWhenPublished) {
    const test::TemporaryFolder folder;
    const fs::path target = folder.path() / "deep" / "report";
    {
        ReportFolder report(target);
        report.write("index.html", "page");
        report.write("pictures/one.txt", "picture");
        EXPECT_FALSE(fs::exists(target));
        report.publish();
    }
    EXPECT_EQ(names_in(folder.path()),
              (std::set<std::string>{"deep", "deep/report", "deep/report/index.html", "deep/report/pictures",
                                     "deep/report/pictures/one.txt"}));
    EXPECT_EQ(read_text(target / "index.html"), "page");
}

TEST(ReportFolder, ReplacesAnOldReportAndKeepsWhatItDidNotMake) {
    const test::TemporaryFolder folder;
    const fs::path target = folder.path() / "report";
    make_old_report(target);
    ReportFolder report(target.string() + "/");
    report.write("index.html", "new page");
    report.write("b.svg", "new figure");
    EXPECT_EQ(read_text(target / "index.html"), "old page");
    report.publish();
    EXPECT_EQ(read_text(target / "index.html"), "new page");
    EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"report", "report/index.html", "report/a.svg",
                                                              "report/b.svg", "report/notes.txt"}));
}

TEST(ReportFolder, LeavesTheOldReportWhenTheWorkFails) {
    const test::TemporaryFolder folder;
    const fs::path target = folder.path() / "report";
    make_old_report(target);
    const std::set<std::string> before = names_in(folder.path());
    EXPECT_THROW(
        {
            ReportFolder report(target);
            report.write("index.html", "half a page");
            throw std::runtime_error("gnuplot failed");
        },
        std::runtime_error);
    EXPECT_EQ(names_in(folder.path()), before);
    EXPECT_EQ(read_text(target / "index.html"), "old page");
}

TEST(ReportFolder, IsPutBackWhenTheMoveFailsInTheMiddle) {
    const test::TemporaryFolder folder;
    const fs::path target = folder.path() / "report";
    make_old_report(target);
    test::write_text(target / "z", "a file where the report needs a folder");
    const std::set<std::string> before = names_in(folder.path());
    {
        ReportFolder report(target);
        report.write("a.svg", "new figure");
        report.write("b.svg", "new figure");
        report.write("index.html", "new page");
        report.write("z/picture.txt", "cannot be moved");
        EXPECT_THAT(message_of([&] { report.publish(); }),
                    testing::AllOf(HasSubstr("--report: "), HasSubstr(target.string())));
    }
    EXPECT_EQ(names_in(folder.path()), before);
    EXPECT_EQ(read_text(target / "a.svg"), "old figure");
    EXPECT_EQ(read_text(target / "index.html"), "old page");
}

TEST(ReportFolder, DoesNotReplaceAFolderByAFile) {
    const test::TemporaryFolder folder;
    fs::create_directories(folder.path() / "report" / "index.html");
    ReportFolder report(folder.path() / "report");
    report.write("index.html", "page");
    EXPECT_THAT(message_of([&] { report.publish(); }), HasSubstr("index.html is a folder there"));
}

TEST(ReportFolder, RefusesAFileBeforeTheWork) {
    const test::TemporaryFolder folder;
    const fs::path file = folder.path() / "file";
    test::write_text(file, "text");
    EXPECT_EQ(message_of([&] { expect_report_folder(file); }),
              "--report: " + file.string() + " is a file, expected a folder for the report");
    EXPECT_EQ(message_of([&] { expect_report_folder(file / "below" / "it"); }),
              "--report: the folder " + (file / "below" / "it").string() +
                  " cannot be made: " + file.string() + " is a file");
    EXPECT_THAT(message_of([&] { ReportFolder report(file); }), HasSubstr("is a file"));
    EXPECT_THAT(message_of([] { expect_report_folder("", "--out"); }), HasSubstr("--out: "));
    EXPECT_EQ(read_text(file), "text");
}

TEST(ReportFolder, MakesNothingWhenOnlyAsked) {
    const test::TemporaryFolder folder;
    EXPECT_NO_THROW(expect_report_folder(folder.path() / "a" / "b"));
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ReportFolder, RefusesAFolderThatCannotBeWritten) {
    const test::TemporaryFolder folder;
    fs::permissions(folder.path(), fs::perms{0555});
    {
        const Unprivileged user;
        EXPECT_EQ(message_of([&] { expect_report_folder(folder.path() / "report"); }),
                  "--report: the folder " + (folder.path() / "report").string() +
                      " cannot be made: " + folder.path().string() + ": Permission denied");
        EXPECT_EQ(message_of([&] { expect_report_folder(folder.path()); }),
                  "--report: the folder " + folder.path().string() +
                      " cannot be written: " + folder.path().string() + ": Permission denied");
        EXPECT_THAT(message_of([&] { ReportFolder report(folder.path() / "report"); }),
                    HasSubstr("cannot be made"));
    }
    EXPECT_TRUE(fs::is_empty(folder.path()));
    fs::permissions(folder.path(), fs::perms::owner_all);
    // Closed to everybody, the superuser included.
    EXPECT_THAT(message_of([] { ReportFolder report("/proc/self/report"); }), HasSubstr("/proc/"));
}

TEST(ReportFolder, TakesTheCurrentFolderAndLinks) {
    const test::TemporaryFolder folder;
    fs::create_directories(folder.path() / "real");
    fs::create_directory_symlink("real", folder.path() / "link");
    {
        ReportFolder report(folder.path() / "link" / ".");
        report.write("index.html", "through a link");
        report.publish();
    }
    EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"link", "real", "real/index.html"}));
    EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
}

TEST(ReportFolder, WritesNothingOutsideItself) {
    const test::TemporaryFolder folder;
    ReportFolder report(folder.path() / "report");
    for (const char* name : {"../x", "/tmp/x", "a/../../x", "", "folder/"})
        EXPECT_THAT(message_of([&] { report.write(name, "text"); }), HasSubstr("would leave")) << name;
}

}  // namespace
}  // namespace goalmouth
