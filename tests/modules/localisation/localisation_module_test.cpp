#include "modules/localisation/localisation_module.h"

#include "core/conversion/kinematics.h"
#include "core/conversion/odometry.h"
#include "core/conversion/particles.h"
#include "core/conversion/pose.h"
#include "core/conversion/posts.h"
#include "core/messaging/memory_bus.h"
#include "core/messaging/typed.h"
#include "core/process/configuration.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr std::int64_t start = 1'700'000'000'000'000;

/// A post on the ground at `axis` [m, in B], as a camera that looks along body x, level, sees it.
Post post_at(const Eigen::Vector2d& axis, double height) {
    const Intrinsics camera;
    const Eigen::Isometry3d T_BC = camera_in_body(height, 0, 0);
    const double distance = axis.norm();
    const double half = std::asin(0.05 / distance);
    const double middle = std::atan2(axis.y(), axis.x());
    const auto pixel = [&](double azimuth, double z) {
        return *project(camera, T_BC.inverse() * Eigen::Vector3d(distance * std::cos(azimuth),
                                                                 distance * std::sin(azimuth), z));
    };
    Post post;
    post.left_top = pixel(middle + half, 0.9);
    post.left_base = pixel(middle + half, 0.0);
    post.right_top = pixel(middle - half, 0.9);
    post.right_base = pixel(middle - half, 0.0);
    post.width_px = post.right_top.x() - post.left_top.x();
    post.distance_m = distance;
    post.bearing_rad = middle;
    post.covariance << 0.01, 0, 0, 1e-4;
    return post;
}

/// A graph of one module on a bus in memory, and what it sends.
struct Graph {
    MemoryHub hub;
    Status status;
    ModuleContext context{hub.endpoint("localisation"), status, "localisation", 5, {}};
    std::vector<std::vector<std::uint8_t>> pose_bytes;
    std::vector<pose_t> poses;
    std::vector<particles_t> particles;
    LocalisationModule module;

    explicit Graph(const LocalisationModule::Parameters& parameters = {}) : module(context, parameters) {
        Bus& ear = hub.endpoint("ear");
        ear.subscribe("POSE", Delivery::every, [this](std::span<const std::uint8_t> m) {
            pose_bytes.emplace_back(m.begin(), m.end());
        });
        subscribe<pose_t>(ear, "POSE", [this](const pose_t& m) { poses.push_back(m); });
        subscribe<particles_t>(ear, "PARTICLES", [this](const particles_t& m) { particles.push_back(m); });
    }
    Bus& mouth() { return hub.endpoint("mouth"); }
};

posts_t posts_message(int i) {
    // The robot stands at (0.5, 0.2) and looks at the opponents' goal.
    const std::vector<Post> posts = {post_at({2.5, 0.55}, 0.42), post_at({2.5, -0.95}, 0.42)};
    return to_message(posts, start + i * 33333, i, Intrinsics{}, "test");
}

kinematics_t kinematics_of(int i) {
    KinematicsSample k;
    k.utime = start + i * 33333;
    k.camera.T_BC = camera_in_body(0.42, 0, 0);
    k.camera.covariance.diagonal().setConstant(1e-5);
    return to_message(k, i);
}

odometry_t odometry_of(int i) {
    return to_message(OdometrySample{start + i * 33333, {1, 2, 3}, 0.2, 0.3, 0}, i);
}

LocalisationModule::Parameters near_the_truth() {
    LocalisationModule::Parameters p;
    p.localiser.filter.initial.x = {0.3};
    p.localiser.filter.initial.y = {0.0};
    p.localiser.filter.initial.theta = {0.1};
    p.localiser.filter.initial.elsewhere_share = 0.0;
    return p;
}

TEST(LocalisationModule, AnswersEveryPostsMessageWithAPose) {
    Graph graph(near_the_truth());
    for (int i = 0; i < 90; ++i) {
        publish(graph.mouth(), "KINEMATICS", kinematics_of(i));
        publish(graph.mouth(), "ODOMETRY", odometry_of(i));
        publish(graph.mouth(), "POSTS", posts_message(i));
        graph.hub.run_until_idle();
        ASSERT_EQ(graph.poses.size(), static_cast<std::size_t>(i + 1));
        EXPECT_EQ(graph.poses.back().utime, start + i * 33333);
        EXPECT_EQ(graph.poses.back().seq, i);
    }
    EXPECT_EQ(graph.status.outputs(), 90);
    EXPECT_EQ(graph.particles.size(), 18U);
    EXPECT_EQ(graph.particles.back().seq, 85);
    EXPECT_NEAR(graph.poses.back().x, 0.5, 0.25);
    EXPECT_NEAR(graph.poses.back().y, 0.2, 0.25);
    EXPECT_NEAR(graph.poses.back().theta, 0.0, 0.1);
    EXPECT_EQ(graph.poses.back().posts_used, 2);
    EXPECT_EQ(graph.status.counters().at("frames_without_odometry"), 0.0);
}

TEST(LocalisationModule, SameBytesHoweverTheChannelsInterleave) {
    std::vector<std::vector<std::uint8_t>> want;
    std::vector<std::string> order = {"KINEMATICS", "ODOMETRY", "POSTS"};
    do {
        Graph graph;
        for (int i = 0; i < 40; ++i) {
            for (const std::string& channel : order) {
                if (channel == "KINEMATICS") publish(graph.mouth(), channel, kinematics_of(i));
                if (channel == "ODOMETRY") publish(graph.mouth(), channel, odometry_of(i));
                if (channel == "POSTS") publish(graph.mouth(), channel, posts_message(i));
            }
            if (i % 3 == 0) graph.hub.run_until_idle();
        }
        graph.hub.run_until_idle();
        ASSERT_EQ(graph.pose_bytes.size(), 40U);
        if (want.empty()) want = graph.pose_bytes;
        EXPECT_EQ(graph.pose_bytes, want);
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST(LocalisationModule, ImagesAloneAreEnough) {
    Graph graph;
    for (int i = 0; i < 60; ++i) publish(graph.mouth(), "POSTS", posts_message(i));
    graph.hub.run_until_idle();
    EXPECT_EQ(graph.poses.size(), 60U);
    EXPECT_EQ(graph.status.counters().at("frames_without_odometry"), 60.0);
    EXPECT_EQ(graph.status.counters().at("frames_without_kinematics"), 60.0);
}

TEST(LocalisationModule, ShippedConfigurationHoldsTheDefaults) {
    const std::filesystem::path file =
        std::filesystem::path(GOALMOUTH_SOURCE_DIR) / "config/modules/localisation.yaml";
    auto shipped = load_parameters<LocalisationModule::Parameters>(file);
    EXPECT_TRUE(std::filesystem::exists(shipped.field));
    shipped.field.clear();
    const auto got = list_parameters(shipped);
    const auto want = list_parameters<LocalisationModule::Parameters>();
    ASSERT_EQ(got.size(), want.size());
    const Configuration text = Configuration::from_file(file);
    for (std::size_t i = 0; i < got.size(); ++i) {
        EXPECT_EQ(got[i].value, want[i].value) << got[i].key;
        const bool is_list = got[i].value.starts_with("[");
        EXPECT_TRUE(is_list || !text.text(got[i].key).empty()) << got[i].key << " is not in the file";
    }
}

TEST(LocalisationModule, StartPosesThatDoNotFitTogetherAreAConfigurationError) {
    auto parameters = near_the_truth();
    parameters.localiser.filter.initial.y = {1.0, 2.0};
    EXPECT_THROW(Graph{parameters}, ConfigurationError);
    parameters = {};
    parameters.field = "/nowhere/field.yaml";
    EXPECT_THROW(Graph{parameters}, ConfigurationError);
}

TEST(LocalisationMessages, SurviveTheWayThereAndBack) {
    PoseEstimate estimate;
    estimate.utime = 7;
    estimate.seq = 8;
    estimate.pose = {1, 2, 3};
    estimate.covariance << 3, 1, 0, 1, 2, 0.5, 0, 0.5, 1;
    estimate.effective_sample_size = 123.0;
    estimate.posts_used = 2;
    estimate.posts_rejected = 1;
    estimate.hypotheses = {{0.7, estimate.pose, estimate.covariance},
                           {0.3, {-1, -2, 0.1}, Eigen::Matrix3d::Identity()}};
    const pose_t m = to_message(estimate);
    EXPECT_FALSE(problem(m)) << *problem(m);
    const PoseEstimate back = from_message(m);
    EXPECT_EQ(back.seq, 8);
    EXPECT_EQ(back.covariance, estimate.covariance);
    ASSERT_EQ(back.hypotheses.size(), 2U);
    EXPECT_EQ(back.hypotheses[1].pose.y, -2);
    EXPECT_EQ(back.posts_rejected, 1);

    KinematicsSample k;
    k.utime = 5;
    k.camera.T_BC = camera_in_body(0.4, 0.1, 0.2, 0.3);
    k.camera.covariance.setIdentity();
    k.camera.covariance(0, 1) = k.camera.covariance(1, 0) = 0.25;
    EXPECT_FALSE(problem(to_message(k, 3)));
    const KinematicsSample k2 = from_message(to_message(k, 3));
    EXPECT_TRUE(k2.camera.T_BC.isApprox(k.camera.T_BC, 1e-12));
    EXPECT_EQ(k2.camera.covariance, k.camera.covariance);

    const OdometrySample o = from_message(to_message(OdometrySample{9, {1, 2, 3}, 0.1, 0.2, 0}, 4));
    EXPECT_EQ(o.utime, 9);
    EXPECT_EQ(o.pose.theta, 3);
    EXPECT_EQ(o.rotation_noise, 0.2);

    const Particles particles = {{{1, 2, 3}, 0.25}, {{-1, 0.5, -3}, 0.75}};
    const particles_t p = to_message(particles, 1, 2);
    EXPECT_FALSE(problem(p));
    EXPECT_EQ(from_message(p)[1].pose.y, 0.5);
}

}  // namespace
}  // namespace goalmouth
