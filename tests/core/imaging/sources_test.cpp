#include "core/imaging/calibration.h"
#include "core/imaging/directory_source.h"
#include "core/imaging/file_error.h"
#include "core/imaging/jpeg.h"
#include "core/imaging/v4l2_source.h"
#include "core/imaging/video_source.h"
#include "tests/support/data.h"
#include "tests/support/files.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/videoio.hpp>

namespace goalmouth {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using namespace std::chrono_literals;

constexpr auto no_wait = 0ms;

class Sources : public testing::Test {
  protected:
    void picture(const std::string& name, int grey, int width = 8, int height = 4) {
        test::write_grey_picture(folder_.path() / name, grey, width, height);
    }
    void text(const std::string& name, const std::string& content) {
        test::write_text(folder_.path() / name, content);
    }
    SourceLog log() {
        return [this](const std::string& what) { said_.push_back(what); };
    }
    /// Luma of the first pixel of each image up to the end, at most `most`.
    static std::vector<int> lumas(ImageSource& source, std::size_t most = 100) {
        std::vector<int> out;
        Captured frame;
        while (out.size() < most && source.next(frame, no_wait) == ImageSource::Outcome::captured)
            out.push_back(frame.bytes[0]);
        return out;
    }
    test::TemporaryFolder folder_;
    std::vector<std::string> said_;
};

TEST_F(Sources, AFolderComesInTheOrderOfNames) {
    picture("b.png", 20);
    picture("a2.ppm", 10);
    picture("c.bmp", 30);
    text("notes.txt", "not an image");
    DirectorySource source(folder_.path(), {}, false, log());
    EXPECT_THAT(lumas(source), ElementsAre(10, 20, 30));
    EXPECT_EQ(source.file().filename(), "c.bmp");
    Captured frame;
    EXPECT_EQ(source.next(frame, no_wait), ImageSource::Outcome::ended);
    EXPECT_TRUE(said_.empty());
}

TEST_F(Sources, DamagedFilesAmongGoodOnesAreSkippedCountedAndSaidOnce) {
    picture("1.png", 10);
    text("2.png", "no picture");
    text("3.png", "");
    picture("4.png", 40);
    text("5.jpg", "\xff\xd8\xff\xe0 cut");
    DirectorySource source(folder_.path(), {}, true, log());
    EXPECT_THAT(lumas(source, 5), ElementsAre(10, 40, 10, 40, 10));
    EXPECT_EQ(source.counters().unreadable, 6) << "three in each of two rounds";
    EXPECT_EQ(said_.size(), 3U) << "each file once, in two rounds";
    EXPECT_THAT(said_[0], HasSubstr("2.png"));
    EXPECT_THAT(said_[1], HasSubstr("0 bytes"));
}

TEST_F(Sources, ALoopOverNothingReadableEnds) {
    text("1.png", "no picture");
    DirectorySource source(folder_.path(), {}, true, log());
    EXPECT_THAT(lumas(source), ElementsAre());
}

TEST_F(Sources, RawImagesNeedTheSizeOthersDoNot) {
    picture("1.png", 10);
    YuyvImage raw(6, 2);
    std::fill(raw.data.begin(), raw.data.end(), std::uint8_t{77});
    write_yuyv(folder_.path() / "2.yuyv", raw.view());
    DirectorySource source(folder_.path(), ImageSize{6, 2}, false, log());
    EXPECT_THAT(lumas(source), ElementsAre(10, 77));
    DirectorySource without(folder_.path(), {}, false, log());
    EXPECT_THAT(lumas(without), ElementsAre(10));
}

TEST_F(Sources, OnePixelIsAnImage) {
    picture("1.png", 99, 1, 1);
    DirectorySource source(folder_.path(), {}, false, log());
    Captured frame;
    ASSERT_EQ(source.next(frame, no_wait), ImageSource::Outcome::captured);
    EXPECT_EQ(frame.width, 1);
    EXPECT_EQ(frame.height, 1);
    EXPECT_EQ(frame.bytes.size(), 4U);
}

TEST_F(Sources, AFileMayStandForAFolder) {
    picture("1.png", 10);
    picture("2.png", 20);
    DirectorySource source(folder_.path() / "2.png", {}, false, log());
    EXPECT_THAT(lumas(source), ElementsAre(20));
}

TEST_F(Sources, AFolderWithoutImagesIsAnError) {
    text("notes.txt", "not an image");
    EXPECT_THROW(DirectorySource(folder_.path(), {}, false, log()), FileError);
    EXPECT_THROW(DirectorySource(folder_.path() / "none", {}, false, log()), FileError);
}

TEST_F(Sources, AVideoIsReadToItsEndOrForEver) {
    const auto file = folder_.path() / "v.avi";
    {
        cv::VideoWriter writer(file.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 15.0, {64, 48});
        ASSERT_TRUE(writer.isOpened());
        for (int i = 0; i < 5; ++i) writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(40 * i + 20)));
    }
    VideoSource once(file, false, log());
    EXPECT_NEAR(once.frames_per_second(), 15.0, 0.1);
    const std::vector<int> seen = lumas(once);
    ASSERT_EQ(seen.size(), 5U);
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(seen[static_cast<std::size_t>(i)], 40 * i + 20, 6);

    VideoSource looping(file, true, log());
    const std::vector<int> twice = lumas(looping, 10);
    ASSERT_EQ(twice.size(), 10U);
    EXPECT_EQ(twice[0], twice[5]);
}

TEST_F(Sources, WhatIsNoVideoIsAnError) {
    text("v.avi", "no video");
    text("empty.avi", "");
    EXPECT_THROW(VideoSource(folder_.path() / "v.avi", false, log()), FileError);
    EXPECT_THROW(VideoSource(folder_.path() / "empty.avi", false, log()), FileError);
    EXPECT_THROW(VideoSource(folder_.path() / "none.avi", false, log()), FileError);
}

TEST_F(Sources, ACameraThatIsNotThereIsNamed) {
    V4l2Settings settings;
    settings.device = (folder_.path() / "video7").string();
    EXPECT_THROW(
        {
            try {
                V4l2Source source(settings, log());
            } catch (const std::runtime_error& error) {
                EXPECT_THAT(error.what(), HasSubstr("video7"));
                throw;
            }
        },
        std::runtime_error);
    settings.device = "/dev/null";
    EXPECT_THROW(V4l2Source(settings, log()), std::runtime_error);
}

TEST(Calibration, IsScaledToAnotherResolutionAndRefusedForAnotherShape) {
    Intrinsics camera;
    camera.distortion[0] = -0.1;
    EXPECT_EQ(calibration_for(camera, 640, 480), camera);
    const auto larger = calibration_for(camera, 1280, 960);
    ASSERT_TRUE(larger);
    EXPECT_NEAR(larger->fx, 2.0 * camera.fx, 1e-9);
    EXPECT_EQ(larger->distortion, camera.distortion);
    EXPECT_EQ(calibration_for(camera, 640, 360), std::nullopt);
    EXPECT_EQ(calibration_for(camera, 1, 480), std::nullopt);
}

TEST(Calibration, IsAssumedWhereNobodyMeasured) {
    const Intrinsics camera = assumed_camera(640, 480);
    EXPECT_NEAR(camera.fx, 554.26, 0.01);
    EXPECT_EQ(assumed_camera(1, 1).width, 1);
}

/// One slot, or none while there is no room.
class OneSlot : public FrameMemory {
  public:
    FrameSlot open(std::size_t bytes) override {
        if (!room) return {};
        EXPECT_FALSE(std::exchange(open_, true));
        bytes_.assign(bytes, 0);
        return {*this, 0, bytes_};
    }
    int slots() const override { return 1; }
    bool room = true;

  private:
    void abandon(int) noexcept override { open_ = false; }
    bool open_ = false;
    std::vector<std::uint8_t> bytes_;
};

TEST_F(Sources, ImagesAreReadAndDecodedStraightIntoTheMemoryGiven) {
    picture("a.png", 10);
    picture("b.jpg", 20);
    write_yuyv(folder_.path() / "c.yuyv", YuyvImage(8, 4).view());
    text("d.png", "broken");
    picture("e.png", 40);
    OneSlot memory;
    DirectorySource source(folder_.path(), ImageSize{8, 4}, true, log(), &memory);
    for (int round = 0; round < 2; ++round) {
        memory.room = round == 0;
        for (const int luma : {10, 20, 0, 40}) {
            Captured frame;
            ASSERT_EQ(source.next(frame, no_wait), ImageSource::Outcome::captured);
            EXPECT_EQ(static_cast<bool>(frame.slot), memory.room);
            if (frame.slot) {
                EXPECT_EQ(frame.bytes.data(), frame.slot.bytes().data());
            }
            EXPECT_EQ(frame.bytes.size(), 64U);
            EXPECT_NEAR(frame.bytes[0], luma, 1);
            EXPECT_EQ(frame.stride, 16);
        }
    }
}

}  // namespace
}  // namespace goalmouth
