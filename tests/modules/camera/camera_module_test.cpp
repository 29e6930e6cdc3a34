#include "modules/camera/camera_module.h"

#include "core/imaging/image_file.h"
#include "core/imaging/jpeg.h"
#include "core/messaging/frame_ring.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"
#include "core/process/run_module.h"
#include "tests/core/imaging/fake_v4l2.h"
#include "tests/support/data.h"
#include "tests/support/files.h"
#include "tests/support/small_shared_memory.h"

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <goalmouth/camera_info_t.hpp>
#include <goalmouth/image_t.hpp>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Camera : public testing::Test {
  protected:
    Camera() {
        auto& receiver = hub_.endpoint("receiver");
        subscribe<image_t>(receiver, "IMAGE", [this](const image_t& m) {
            images_.push_back(m);
            const auto frame = reader_.try_open(m);
            if (!pixels_expected_) return;
            ASSERT_TRUE(frame) << "the pixels are to be had";
            first_lumas_.push_back(frame->bytes()[0]);
        });
        subscribe<camera_info_t>(receiver, "CAMERA_INFO",
                                 [this](const camera_info_t& m) { infos_.push_back(m); });
        parameters_.source = "directory";
        parameters_.path = folder_.path().string();
        parameters_.frames_per_second = 500.0;
        parameters_.linger = 0.0;
        parameters_.start_time = 1.7e9;
    }
    void picture(const std::string& name, int grey, int width = 64, int height = 48) {
        test::write_grey_picture(folder_.path() / name, grey, width, height);
    }
    void text(const std::string& name, const std::string& content) {
        test::write_text(folder_.path() / name, content);
    }
    /// Runs the module until it has finished or sent `most` images.
    void run(std::size_t most = 1000) {
        auto& bus = hub_.endpoint("camera");
        ModuleContext context{bus, status_, "camera", 0, {}};
        CameraModule module(context, parameters_);
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (!module.finished() && images_.size() < most && std::chrono::steady_clock::now() < deadline) {
            module.tick();
            bus.dispatch(std::chrono::milliseconds(0));
        }
    }
    std::string error() {
        try {
            run();
        } catch (const ConfigurationError& e) {
            return e.what();
        }
        return "no error";
    }

    test::TemporaryFolder folder_;
    MemoryHub hub_;
    Status status_;
    CameraParameters parameters_;
    RingReader reader_;
    std::vector<image_t> images_;
    std::vector<camera_info_t> infos_;
    std::vector<int> first_lumas_;
    bool pixels_expected_ = true;
};

TEST_F(Camera, SendsAFolderOnceAndEnds) {
    picture("a.png", 10);
    picture("b.png", 20);
    text("c.png", "broken");
    picture("d.png", 40);
    run();
    EXPECT_THAT(first_lumas_, ElementsAre(10, 20, 40));
    ASSERT_EQ(images_.size(), 3U);
    for (std::size_t i = 0; i < images_.size(); ++i) {
        EXPECT_EQ(images_[i].seq, static_cast<std::int64_t>(i));
        EXPECT_EQ(images_[i].utime, 1700000000000000 + static_cast<std::int64_t>(i) * 2000);
        EXPECT_EQ(images_[i].width, 64);
        EXPECT_EQ(images_[i].intrinsics.width, 64);
        EXPECT_EQ(images_[i].encoding, "yuyv");
        EXPECT_EQ(images_[i].camera, "camera");
    }
    EXPECT_EQ(status_.outputs(), 3);
    EXPECT_EQ(status_.counters().at("unreadable_images"), 1.0);
}

TEST_F(Camera, LoopsWhereAsked) {
    picture("a.png", 10);
    picture("b.png", 20);
    parameters_.loop = true;
    run(5);
    EXPECT_THAT(first_lumas_, ElementsAre(10, 20, 10, 20, 10));
}

TEST_F(Camera, SaysWhoItIsOnceASecondOfCaptureTime) {
    picture("a.png", 10);
    parameters_.loop = true;
    parameters_.frames_per_second = 1000.0;
    parameters_.camera_name = "left eye";
    run(2001);
    ASSERT_EQ(infos_.size(), 3U);
    EXPECT_EQ(infos_[0].camera, "left eye");
    EXPECT_EQ(infos_[0].source, folder_.path().string());
    EXPECT_EQ(infos_[0].frames_per_second, 1000.0);
    EXPECT_EQ(infos_[1].utime - infos_[0].utime, 1000000);
    EXPECT_NEAR(infos_[0].intrinsics.fx, 64.0 / (2.0 * std::tan(M_PI / 6.0)), 1e-9);
}

TEST_F(Camera, ScalesTheCalibrationAndSkipsImagesOfAnotherShape) {
    picture("a.png", 10, 64, 48);
    picture("b.png", 20, 64, 64);
    picture("c.png", 30, 128, 96);
    text("eye.yaml", "width: 640\nheight: 480\nfx: 500\nfy: 500\ncx: 320\ncy: 240\n");
    parameters_.camera = (folder_.path() / "eye.yaml").string();
    run();
    EXPECT_THAT(first_lumas_, ElementsAre(10, 30));
    EXPECT_NEAR(images_.at(0).intrinsics.fx, 50.0, 1e-9);
    EXPECT_NEAR(images_.at(1).intrinsics.fx, 100.0, 1e-9);
    EXPECT_EQ(status_.counters().at("wrong_shape"), 1.0);
}

TEST_F(Camera, SendsAnImageOfOnePixel) {
    picture("a.png", 10, 1, 1);
    run();
    ASSERT_EQ(images_.size(), 1U);
    EXPECT_EQ(images_[0].width, 1);
}

TEST_F(Camera, FilesAreReadAndDecodedStraightIntoSharedMemory) {
    picture("a.png", 10, 640, 480);
    picture("b.jpg", 20, 640, 480);
    write_yuyv(folder_.path() / "c.yuyv", YuyvImage(640, 480).view());
    run();
    EXPECT_THAT(first_lumas_, ElementsAre(10, 20, 0));
    EXPECT_EQ(status_.counters().at("frames_in_place"), 3.0);
    EXPECT_EQ(status_.counters().at("copied_frames"), 0.0);
    EXPECT_EQ(status_.counters().at("missed_frames"), 0.0);
}

/// A JPEG whose header claims another height.
std::vector<std::uint8_t> jpeg_of(int grey, int claimed_height = 0) {
    YuyvImage image(64, 48);
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = static_cast<std::uint8_t>(i % 2 == 0 ? grey : 128);
    auto jpeg = jpeg_from_yuyv(image.view(), 90);
    for (std::size_t i = 0; claimed_height > 0 && i + 6 < jpeg.size(); ++i) {
        if (jpeg[i] != 0xff || jpeg[i + 1] != 0xc0) continue;
        jpeg[i + 5] = static_cast<std::uint8_t>(claimed_height >> 8);
        jpeg[i + 6] = static_cast<std::uint8_t>(claimed_height);
        break;
    }
    return jpeg;
}

TEST_F(Camera, ADamagedMotionJpegHeaderAsksForNoMemory) {
    test::FakeCamera camera;
    camera.offered = V4L2_PIX_FMT_MJPEG;
    camera.width = 64;
    camera.height = 48;
    for (const int height : {0, 16384, 47, 0}) {
        test::FakeCamera::Event event;
        event.bytes = jpeg_of(90, height);
        event.sequence = static_cast<std::uint32_t>(camera.events.size());
        camera.events.push_back(event);
    }
    parameters_.source = "v4l2";
    parameters_.device = test::FakeCamera::path;
    parameters_.format = "mjpeg";
    parameters_.width = 64;
    parameters_.height = 48;
    run(2);
    ASSERT_EQ(images_.size(), 2U);
    EXPECT_EQ(images_[0].ring, images_[1].ring) << "the ring stays";
    EXPECT_EQ(status_.counters().at("damaged_jpeg"), 2.0);
    EXPECT_EQ(status_.counters().at("frames_in_place"), 2.0);
}

TEST_F(Camera, ADamagedHeaderOfAFileDoesNotReplaceTheRing) {
    picture("a.png", 10);
    write_bytes(folder_.path() / "b.jpg", jpeg_of(20, 8000));
    picture("c.png", 30);
    picture("d.png", 40, 640, 480);
    picture("e.png", 50, 640, 480);
    run();
    EXPECT_THAT(first_lumas_, ElementsAre(10, 30, 40, 50));
    EXPECT_EQ(images_.at(0).ring, images_.at(1).ring);
    EXPECT_NE(images_.at(1).ring, images_.at(2).ring) << "an image that is one makes it larger";
    EXPECT_EQ(images_.at(2).ring, images_.at(3).ring);
    EXPECT_EQ(status_.counters().at("unreadable_images"), 1.0);
    EXPECT_EQ(status_.counters().at("copied_frames"), 1.0);
    EXPECT_EQ(status_.counters().at("frames_in_place"), 3.0);
}

TEST_F(Camera, SaysHowManyCopiesItMadeBeforeItMadeAny) {
    picture("a.png", 10);
    ModuleContext context{hub_.endpoint("camera"), status_, "camera", 0, {}};
    const CameraModule module(context, parameters_);
    EXPECT_EQ(status_.counters().at("copied_frames"), 0.0);
}

TEST_F(Camera, GoesOnWithoutRoomInSharedMemoryAndCountsWhatItCouldNotSend) {
    picture("a.png", 10, 640, 480);
    parameters_.loop = true;
    const auto film = [this] {
        auto& bus = hub_.endpoint("camera");
        ModuleContext context{bus, status_, "camera", 0, {}};
        CameraModule module(context, parameters_);
        const auto run_until = [&](const std::function<bool()>& done) {
            const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
            while (!done() && std::chrono::steady_clock::now() < deadline) {
                module.tick();
                bus.dispatch(std::chrono::milliseconds(0));
            }
            return done();
        };
        pixels_expected_ = false;
        EXPECT_TRUE(run_until([&] { return images_.size() == 5; }));
        EXPECT_EQ(status_.counters().at("missed_frames"), 5.0);
        EXPECT_EQ(status_.dropped_frames(), 5);
        EXPECT_EQ(status_.outputs(), 0);
        test::resize_shared_memory(16);
        pixels_expected_ = true;
        EXPECT_TRUE(run_until([&] { return images_.size() == 8; }));
        EXPECT_EQ(images_.back().seq, 7) << "numbers go on, so that consumers see the gap";
        EXPECT_THAT(first_lumas_, ElementsAre(10, 10, 10));
        EXPECT_EQ(status_.dropped_frames(), 5);
    };
    if (const std::string why = test::with_small_shared_memory(2, film); !why.empty())
        GTEST_SKIP() << "skipped: " << why;
}

TEST_F(Camera, MistakesInItsConfigurationAreNamed) {
    EXPECT_THAT(error(), HasSubstr("holds no image"));
    parameters_.path = "";
    EXPECT_THAT(error(), HasSubstr("path"));
    parameters_.source = "video";
    parameters_.path = (folder_.path() / "none.avi").string();
    EXPECT_THAT(error(), HasSubstr("none.avi"));
    picture("a.png", 10);
    parameters_.source = "directory";
    parameters_.path = folder_.path().string();
    parameters_.camera = (folder_.path() / "none.yaml").string();
    EXPECT_THAT(error(), HasSubstr("none.yaml"));
}

TEST_F(Camera, ALingeringSourceKeepsItsPixelsForLateReaders) {
    picture("a.png", 10);
    parameters_.linger = 0.2;
    auto& bus = hub_.endpoint("camera");
    ModuleContext context{bus, status_, "camera", 0, {}};
    CameraModule module(context, parameters_);
    const auto begun = std::chrono::steady_clock::now();
    while (images_.empty()) {
        module.tick();
        bus.dispatch(std::chrono::milliseconds(0));
    }
    while (!module.finished()) {
        module.tick();
        if (std::chrono::steady_clock::now() - begun > std::chrono::seconds(30)) break;
    }
    EXPECT_GE(std::chrono::steady_clock::now() - begun, std::chrono::milliseconds(200));
    EXPECT_TRUE(module.finished());
    EXPECT_TRUE(reader_.try_open(images_.back()));
}

TEST(CameraConfiguration, TheShippedFileHoldsTheDefaults) {
    const std::filesystem::path file = std::string(GOALMOUTH_SOURCE_DIR) + "/config/modules/camera.yaml";
    const auto shipped = list_parameters(load_parameters<CameraParameters>(file));
    const auto defaults = list_parameters<CameraParameters>();
    ASSERT_EQ(shipped.size(), defaults.size());
    const Configuration configuration = Configuration::from_file(file);
    for (std::size_t i = 0; i < defaults.size(); ++i)
        EXPECT_EQ(shipped[i].value, defaults[i].value) << defaults[i].key;
}

}  // namespace
}  // namespace goalmouth
