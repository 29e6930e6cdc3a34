#include "core/conversion/truth.h"
#include "core/messaging/channels.h"
#include "core/messaging/image_input.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"
#include "core/process/run_module.h"
#include "modules/simulator/simulator_module.h"
#include "tests/support/data.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <goalmouth/camera_info_t.hpp>
#include <goalmouth/kinematics_t.hpp>
#include <goalmouth/odometry_t.hpp>
#include <goalmouth/truth_t.hpp>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using testing::ElementsAre;

/// What a run of the simulator published, in order.
struct Recording {
    std::vector<std::string> order;
    std::vector<truth_t> truth;
    std::vector<kinematics_t> kinematics;
    std::vector<odometry_t> odometry;
    std::vector<camera_info_t> camera_info;
    std::vector<std::vector<std::uint8_t>> images;
    std::vector<std::int64_t> image_utimes, image_seqs;
    std::map<std::string, double> counters;
};

SimulatorParameters few_frames(int frames) {
    SimulatorParameters p;
    p.realtime = false;
    p.frames = frames;
    p.start_time = 1.7e9;
    p.linger = 0.0;
    return p;
}

Recording record(const SimulatorParameters& parameters, std::uint64_t seed = 1) {
    Recording result;
    MemoryHub hub;
    MemoryBus& listener = hub.endpoint("listener");
    subscribe<kinematics_t>(listener, channels::kinematics, [&](const kinematics_t& m) {
        result.order.emplace_back("kinematics");
        result.kinematics.push_back(m);
    });
    subscribe<odometry_t>(listener, channels::odometry, [&](const odometry_t& m) {
        result.order.emplace_back("odometry");
        result.odometry.push_back(m);
    });
    subscribe<truth_t>(listener, channels::truth, [&](const truth_t& m) {
        result.order.emplace_back("truth");
        result.truth.push_back(m);
    });
    subscribe<camera_info_t>(listener, channels::camera_info,
                             [&](const camera_info_t& m) { result.camera_info.push_back(m); });
    subscribe<image_t>(listener, channels::image,
                       [&](const image_t&) { result.order.emplace_back("image"); });
    const ImageInput input(listener, channels::image, "", "", [&](const Frame& frame) {
        std::vector<std::uint8_t> bytes(frame.pixels.data,
                                        frame.pixels.data + frame.pixels.stride * frame.pixels.height);
        ASSERT_TRUE(frame.still_valid());
        result.images.push_back(std::move(bytes));
        result.image_utimes.push_back(frame.utime);
        result.image_seqs.push_back(frame.seq);
    });
    Status status;
    ModuleContext context{hub.endpoint("simulator"), status, "simulator", seed, {}};
    SimulatorModule module(context, parameters);
    for (int i = 0; i < 100000 && !module.finished(); ++i) {
        module.tick();
        hub.run_until_idle();
    }
    EXPECT_TRUE(module.finished());
    EXPECT_EQ(listener.counters().rejected_total(), 0);
    result.counters = status.counters();
    return result;
}

TEST(Simulator, PublishesKinematicsOdometryTruthAndImageOfEachFrame) {
    const Recording run = record(few_frames(3));
    EXPECT_THAT(run.order, ElementsAre("kinematics", "odometry", "truth", "image", "kinematics", "odometry",
                                       "truth", "image", "kinematics", "odometry", "truth", "image"));
    ASSERT_EQ(run.images.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t utime = 1700000000000000 + std::llround(1e6 * static_cast<double>(k) / 30.0);
        EXPECT_EQ(run.image_utimes[k], utime);
        EXPECT_EQ(run.kinematics[k].utime, utime);
        EXPECT_EQ(run.odometry[k].utime, utime);
        EXPECT_EQ(run.truth[k].utime, utime);
        EXPECT_EQ(run.image_seqs[k], static_cast<std::int64_t>(k));
        EXPECT_EQ(run.kinematics[k].seq, static_cast<std::int64_t>(k));
        EXPECT_EQ(run.truth[k].seq, static_cast<std::int64_t>(k));
        EXPECT_EQ(run.images[k].size(), 640U * 480U * 2U);
    }
}

TEST(Simulator, AnnouncesItsCameraOnceASecond) {
    SimulatorParameters p = few_frames(25);
    p.frames_per_second = 10.0;
    const Recording run = record(p);
    ASSERT_EQ(run.camera_info.size(), 3U);
    EXPECT_EQ(run.camera_info[0].camera, "simulator");
    EXPECT_EQ(run.camera_info[0].intrinsics.width, 640);
    EXPECT_EQ(run.camera_info[1].utime - run.camera_info[0].utime, 1000000);
}

TEST(Simulator, SameSeedSameRun) {
    const Recording one = record(few_frames(4), 5);
    const Recording two = record(few_frames(4), 5);
    const Recording other = record(few_frames(4), 6);
    EXPECT_EQ(one.images, two.images);
    EXPECT_NE(one.images, other.images);
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(one.odometry[k].x, two.odometry[k].x);
        EXPECT_EQ(one.kinematics[k].quaternion[1], two.kinematics[k].quaternion[1]);
    }
    EXPECT_NE(one.kinematics[0].quaternion[1], other.kinematics[0].quaternion[1]);
}

TEST(Simulator, RealTimeRunsSendEveryFrameThatIsNotLate) {
    SimulatorParameters p = few_frames(5);
    p.realtime = true;
    p.frames_per_second = 1000.0;  // faster than any frame is rendered
    const Recording run = record(p);
    ASSERT_EQ(run.image_seqs.size(), 5U);
    std::int64_t left_out = 0;
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_EQ(run.image_seqs[k], static_cast<std::int64_t>(k));
        if (k > 0) {
            ASSERT_GT(run.image_utimes[k], run.image_utimes[k - 1]);
            left_out += (run.image_utimes[k] - run.image_utimes[k - 1]) / 1000 - 1;
        }
    }
    const auto late = run.counters.find("late_frames");
    EXPECT_EQ(late == run.counters.end() ? 0.0 : late->second, static_cast<double>(left_out));
}

TEST(Simulator, TruthSurvivesItsMessage) {
    const Recording run = record(few_frames(1));
    const Truth truth = from_message(run.truth.at(0));
    const truth_t again = to_message(truth, run.truth[0].utime, run.truth[0].seq);
    EXPECT_EQ(again.num_posts, run.truth[0].num_posts);
    EXPECT_GT(again.num_posts, 0);
    EXPECT_NEAR(again.camera_quaternion[2], run.truth[0].camera_quaternion[2], 1e-12);
    EXPECT_EQ(again.posts[0].left_top[0], run.truth[0].posts[0].left_top[0]);
    EXPECT_NEAR(run.truth[0].x, -1.8, 1e-9);
    EXPECT_NEAR(run.truth[0].ball_x, -1.2, 1e-12);
}

TEST(Simulator, ConfigurationOfTheProjectIsTheDefault) {
    const std::filesystem::path config = std::filesystem::path(GOALMOUTH_SOURCE_DIR) / "config";
    auto from_file = load_parameters<SimulatorParameters>(config / "modules" / "simulator.yaml");
    EXPECT_EQ(load_parameters<Intrinsics>(std::filesystem::path(from_file.camera)), Intrinsics{});
    const auto field = list_parameters(load_parameters<Field>(std::filesystem::path(from_file.field)));
    const auto default_field = list_parameters<Field>();
    for (std::size_t i = 0; i < field.size(); ++i)
        EXPECT_EQ(field[i].value, default_field[i].value) << field[i].key;
    const auto scene =
        list_parameters(load_parameters<ImageFormationParameters>(std::filesystem::path(from_file.scene)));
    const auto default_scene = list_parameters<ImageFormationParameters>();
    for (std::size_t i = 0; i < scene.size(); ++i)
        EXPECT_EQ(scene[i].value, default_scene[i].value) << scene[i].key;
    from_file.camera.clear();
    from_file.field.clear();
    from_file.scene.clear();
    const auto read = list_parameters(from_file);
    const auto defaults = list_parameters<SimulatorParameters>();
    ASSERT_EQ(read.size(), defaults.size());
    for (std::size_t i = 0; i < read.size(); ++i) EXPECT_EQ(read[i].value, defaults[i].value) << read[i].key;
}

TEST(Simulator, EveryFieldAndCameraOfTheProjectLoads) {
    const std::filesystem::path config = std::filesystem::path(GOALMOUTH_SOURCE_DIR) / "config";
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(config / "fields")) {
        if (entry.path().extension() != ".yaml") continue;
        SimulatorParameters p = few_frames(1);
        p.field = entry.path().string();
        EXPECT_EQ(record(p).images.size(), 1U) << entry.path();
        ++files;
    }
    for (const auto& entry : std::filesystem::directory_iterator(config / "cameras")) {
        if (entry.path().extension() != ".yaml") continue;
        SimulatorParameters p = few_frames(1);
        p.camera = entry.path().string();
        EXPECT_EQ(record(p).images.size(), 1U) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 9);
}

TEST(Simulator, WrongConfigurationSaysWhat) {
    MemoryHub hub;
    Status status;
    ModuleContext context{hub.endpoint("simulator"), status, "simulator", 1, {}};
    const test::TemporaryFolder folder;
    const auto with_scene = [&](const std::string& text) {
        SimulatorParameters p;
        p.scene = (folder.path() / "scene.yaml").string();
        std::ofstream(p.scene) << text;
        return p;
    };
    EXPECT_THROW(SimulatorModule(context, with_scene("hall: {carpet: [1, 2]}\n")), ConfigurationError);
    try {
        SimulatorModule module(context, with_scene("sensor:\n  blur: 1\n  vignetting: -1\n"));
        FAIL() << "a wrong value in a scene file was accepted";
    } catch (const ConfigurationError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("scene.yaml:3"));
        EXPECT_THAT(error.what(), testing::HasSubstr("sensor.vignetting"));
    }
    SimulatorParameters missing;
    missing.field = "/nowhere/field.yaml";
    try {
        SimulatorModule module(context, missing);
        FAIL() << "a missing field file was accepted";
    } catch (const ConfigurationError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("/nowhere/field.yaml"));
    }
    EXPECT_THROW(
        load_parameters<SimulatorParameters>(Configuration::from_text("walk: {gait: {speed: -1}}", "test")),
        ConfigurationError);
}

}  // namespace
}  // namespace goalmouth
