#include "core/imaging/image_file.h"

#include "core/imaging/conversion.h"
#include "core/imaging/file_error.h"
#include "core/imaging/jpeg.h"
#include "tests/support/data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace goalmouth {
namespace {

using testing::HasSubstr;

class ImageFile : public testing::Test {
  protected:
    std::filesystem::path write(const std::string& name, const std::string& content) {
        const auto file = folder_.path() / name;
        write_bytes(file, {reinterpret_cast<const std::uint8_t*>(content.data()), content.size()});
        return file;
    }
    cv::Mat picture() const {
        cv::Mat bgr(6, 8, CV_8UC3, cv::Scalar(30, 180, 220));
        bgr.colRange(4, 8).setTo(cv::Scalar(60, 130, 50));
        return bgr;
    }
    std::filesystem::path write_picture(const std::string& name) {
        const auto file = folder_.path() / name;
        EXPECT_TRUE(cv::imwrite(file.string(), picture()));
        return file;
    }
    static std::string error_of(const std::filesystem::path& file,
                                std::optional<ImageSize> size = std::nullopt) {
        try {
            read_image(file, size);
        } catch (const FileError& error) {
            return error.what();
        }
        return "no error";
    }
    test::TemporaryFolder folder_;
};

TEST_F(ImageFile, ReadsPngAndPpmExactly) {
    for (const char* name : {"a.png", "a.ppm"}) {
        const YuyvImage image = read_image(write_picture(name));
        EXPECT_EQ(image.width, 8);
        EXPECT_EQ(image.height, 6);
        EXPECT_EQ(image.data, yuyv_from_bgr(picture()).data) << name;
    }
}

TEST_F(ImageFile, ReadsJpegNearly) {
    const YuyvImage image = read_image(write_picture("a.jpg"));
    ASSERT_EQ(image.width, 8);
    const Ycbcr expected = ycbcr_from_bgr({30, 180, 220});
    EXPECT_NEAR(image.view().at(1, 1).y, expected.y, 6);
    EXPECT_NEAR(image.view().at(1, 1).cb, expected.cb, 10);
}

TEST_F(ImageFile, WritesAndReadsRawImages) {
    const YuyvImage image = yuyv_from_bgr(picture());
    const auto file = folder_.path() / "a.yuyv";
    write_yuyv(file, image.view());
    EXPECT_EQ(read_image(file, ImageSize{8, 6}).data, image.data);
}

TEST_F(ImageFile, WantsTheSizeOfRawImages) {
    const auto file = folder_.path() / "a.yuyv";
    write_yuyv(file, YuyvImage(4, 2).view());
    EXPECT_THAT(error_of(file), HasSubstr("640x480"));
}

TEST_F(ImageFile, SaysFoundAndExpectedForRawImagesOfWrongSize) {
    const auto file = folder_.path() / "a.yuyv";
    write_yuyv(file, YuyvImage(4, 2).view());
    const std::string error = error_of(file, ImageSize{640, 480});
    EXPECT_THAT(error, HasSubstr("a.yuyv"));
    EXPECT_THAT(error, HasSubstr("16 bytes"));
    EXPECT_THAT(error, HasSubstr("614400"));
}

TEST_F(ImageFile, SaysWhereTheSizeIsNotTheExpectedOne) {
    const std::string error = error_of(write_picture("a.png"), ImageSize{640, 480});
    EXPECT_THAT(error, HasSubstr("8x6"));
    EXPECT_THAT(error, HasSubstr("640x480"));
}

TEST_F(ImageFile, RefusesEmptyMissingAndDamagedFiles) {
    EXPECT_THAT(error_of(write("empty.png", "")), HasSubstr("0 bytes"));
    EXPECT_THAT(error_of(folder_.path() / "none.png"), HasSubstr("no such file"));
    EXPECT_THAT(error_of(folder_.path()), HasSubstr("not a file"));
    EXPECT_THAT(error_of(write("text.png", "this is no picture")), HasSubstr("18 bytes"));
    EXPECT_THAT(error_of(write("text.jpg", "\xff\xd8\xff no picture")), HasSubstr("text.jpg"));
}

TEST_F(ImageFile, RefusesACutPng) {
    const auto bytes = read_bytes(write_picture("a.png"));
    const auto cut = write("cut.png", std::string(bytes.begin(), bytes.begin() + 40));
    EXPECT_THAT(error_of(cut), HasSubstr("damaged"));
}

TEST_F(ImageFile, ReadsASinglePixel) {
    const auto file = folder_.path() / "one.png";
    ASSERT_TRUE(cv::imwrite(file.string(), cv::Mat(1, 1, CV_8UC3, cv::Scalar(1, 2, 3))));
    const YuyvImage image = read_image(file);
    EXPECT_EQ(image.width, 1);
    EXPECT_EQ(image.height, 1);
}

TEST_F(ImageFile, SaysWhereAFileCannotBeWritten) {
    EXPECT_THROW(write_yuyv(folder_.path() / "no" / "such" / "folder.yuyv", YuyvImage(2, 2).view()),
                 FileError);
}

TEST_F(ImageFile, WritingReplacesNeitherADeviceNorALink) {
    const auto write = [](const std::filesystem::path& file) { write_yuyv(file, YuyvImage(2, 2).view()); };
    const auto null = folder_.path() / "null";
    std::filesystem::create_symlink("/dev/null", null);
    write(null);
    EXPECT_TRUE(std::filesystem::is_character_file(null));
    EXPECT_THROW(write("/dev/full"), FileError);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
    const auto link = folder_.path() / "link.yuyv";
    std::filesystem::create_symlink("target.yuyv", link);
    write(link);
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_EQ(std::filesystem::file_size(folder_.path() / "target.yuyv"), 8U);
}

TEST_F(ImageFile, WritingFollowsAChainOfLinks) {
    const auto write = [](const std::filesystem::path& file) { write_yuyv(file, YuyvImage(2, 2).view()); };
    const auto folder = folder_.path() / "deeper";
    std::filesystem::create_directory(folder);
    std::filesystem::create_symlink("deeper/second.yuyv", folder_.path() / "first.yuyv");
    std::filesystem::create_symlink("../third.yuyv", folder / "second.yuyv");
    std::filesystem::create_symlink(folder / "end.yuyv", folder_.path() / "third.yuyv");
    for (const char* when : {"nothing there yet", "something there"}) {
        write(folder_.path() / "first.yuyv");
        for (const auto& link :
             {folder_.path() / "first.yuyv", folder / "second.yuyv", folder_.path() / "third.yuyv"})
            EXPECT_TRUE(std::filesystem::is_symlink(link)) << link << ", " << when;
        EXPECT_EQ(std::filesystem::file_size(folder / "end.yuyv"), 8U) << when;
    }
    std::filesystem::create_symlink("here.yuyv", folder_.path() / "there.yuyv");
    std::filesystem::create_symlink("there.yuyv", folder_.path() / "here.yuyv");
    EXPECT_THROW(write(folder_.path() / "here.yuyv"), FileError);
    EXPECT_TRUE(std::filesystem::is_symlink(folder_.path() / "here.yuyv"));
}

TEST(ImageSize, IsReadFromText) {
    EXPECT_EQ(parse_image_size("640x480"), (ImageSize{640, 480}));
    EXPECT_EQ(parse_image_size("1x1"), (ImageSize{1, 1}));
    for (const char* wrong :
         {"", "640", "640x", "x480", "640x480x", "640 x480", "0x5", "-1x5", "99999x5", "640X480", "1e2x5"})
        EXPECT_EQ(parse_image_size(wrong), std::nullopt) << wrong;
}

}  // namespace
}  // namespace goalmouth
