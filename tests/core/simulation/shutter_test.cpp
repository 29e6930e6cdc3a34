#include "core/simulation/shutter.h"

#include "core/geometry/cylinder.h"
#include "core/simulation/image_motion.h"
#include "core/simulation/renderer.h"
#include "tests/core/simulation/measured.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using Eigen::Vector3d;
using test::camera_at;
using test::covered_in_row;
using test::plain_scene;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double wall = 20.0;
constexpr double goal = 230.0;

/// A frame of the opponents' left post against a dark wall, no blur and no noise.
class MovingCamera : public testing::Test {
  protected:
    MovingCamera() {
        scene.room_margin = 0.3;
        formation = test::plain_formation();
    }

    void stand(double distance, double roll = 0.0) {
        motion.T_WC = camera_at(3.0 - distance, 0.75 - 0.03, 0.013, 0.42, roll, -2 * degree);
    }

    YuyvImage shoot() const {
        Renderer renderer(make_scene(field, scene), camera, formation);
        Random random(1);
        return renderer.render({motion}, random);
    }

    /// Where an edge crosses a row for a camera that stands still.
    double edge(const Eigen::Isometry3d& T_WC, bool left, double row) const {
        const auto outline = silhouette(goalposts(field)[2], T_WC);
        const Vector3d n = left ? outline->left_plane : outline->right_plane;
        const double y = (row - camera.cy) / camera.fy;
        return camera.cx - camera.fx * (n.y() * y + n.z()) / n.x();
    }

    /// The same for the row's own exposure: the mean over it.
    double mean_edge(bool left, int row) const {
        constexpr int instants = 200;
        double sum = 0.0;
        for (int i = 0; i < instants; ++i) {
            const double t =
                (static_cast<double>(row) / (camera.height - 1) - 0.5) * formation.shutter.readout +
                ((i + 0.5) / instants - 0.5) * formation.shutter.exposure;
            sum += edge(motion.at(t), left, row);
        }
        return sum / instants;
    }

    /// Compares the measured edges of rows first…last with the mean over each row's exposure. `reach`: px of
    /// wall on either side that the blurred edge may cover.
    void expect_edges(int first, int last, int reach, double tolerance) const {
        const YuyvImage image = shoot();
        double worst = 0.0;
        int worst_row = -1;
        for (int row = first; row <= last; ++row) {
            const double left = mean_edge(true, row);
            const double right = mean_edge(false, row);
            const int middle = static_cast<int>(std::lround(0.5 * (left + right)));
            const int before = static_cast<int>(std::floor(left)) - reach;
            const int after = static_cast<int>(std::ceil(right)) + reach;
            ASSERT_GE(before, 0) << row;
            ASSERT_LT(after, camera.width) << row;
            const double from = middle + 0.5 - covered_in_row(image, row, before, middle, goal, wall);
            const double to = middle + 0.5 + covered_in_row(image, row, middle + 1, after, goal, wall);
            const double off = std::max(std::abs(from - left), std::abs(to - right));
            if (off > worst) {
                worst = off;
                worst_row = row;
            }
        }
        EXPECT_LT(worst, tolerance) << "row " << worst_row;
    }

    Field field;
    SceneParameters scene = plain_scene();
    Intrinsics camera;
    ImageFormationParameters formation;
    CameraMotion motion;
};

TEST_F(MovingCamera, YawLeansAnUprightEdgeByTheSamePixelsEachRow) {
    stand(1.5);
    formation.shutter.readout = 0.03;
    for (const double rate : {-2.0, 0.5, 3.0}) {
        motion.turn_rate = Vector3d(0.0, rate, 0.0);
        expect_edges(115, 230, 5, 0.02);  // below the crossbar
        // In the middle of the image the lean is f·ω·readout / (h − 1) px a row.
        const double lean = (mean_edge(true, 235) - mean_edge(true, 225)) / 10.0 -
                            (edge(motion.T_WC, true, 235) - edge(motion.T_WC, true, 225)) / 10.0;
        EXPECT_NEAR(lean, -camera.fx * rate * 0.03 / 479.0, 0.01 * std::abs(lean) + 1e-3);
    }
}

TEST_F(MovingCamera, TranslationLeansNearThingsMore) {
    formation.shutter.readout = 0.03;
    for (const double distance : {0.6, 1.5, 3.0}) {
        stand(distance);
        for (const Vector3d& velocity : {Vector3d(0.0, 0.8, 0.0), Vector3d(0.5, -0.3, 0.2)}) {
            motion.velocity = velocity;
            const int below_crossbar = 267 - static_cast<int>(235.0 / distance);
            expect_edges(std::max(below_crossbar, 100), 230, 5, 0.02);
        }
    }
}

TEST_F(MovingCamera, FastestMovementsAreSetUpRowByRow) {
    stand(1.5);
    formation.shutter.readout = 0.033;
    motion.turn_rate = Vector3d(0.0, 12.0, 0.0);
    motion.velocity = Vector3d(0.0, 2.0, 0.0);
    expect_edges(215, 245, 5, 0.02);
}

TEST_F(MovingCamera, RollAndPitchFollowTheRowsToo) {
    formation.shutter.readout = 0.03;
    for (const double roll : {0.0, 12 * degree}) {
        stand(1.5, roll);
        motion.turn_rate = Vector3d(0.7, -0.4, 1.5);
        motion.velocity = Vector3d(0.2, 0.3, 0.1);
        expect_edges(115, 225, 5, 0.02);
    }
}

TEST_F(MovingCamera, LinesOnTheGroundDoNotJumpBetweenBands) {
    // A side line straight ahead, seen from a camera that drifts sideways: its edges are where each row's own
    // pose puts them.
    formation.shutter.readout = 0.03;
    motion.T_WC = camera_at(-1.0, 1.7, 0.35, 0.42, 0.0, 25 * degree);
    motion.velocity = Vector3d(0.0, 0.6, 0.05);
    motion.turn_rate = Vector3d(0.2, 0.8, 0.5);
    const YuyvImage image = shoot();
    int rows = 0;
    for (int row = 120; row < 420; ++row) {
        const Eigen::Isometry3d T_WC = motion.at(row_time(formation.shutter, row, camera.height));
        const auto crossing = [&](double y) {
            double low = -0.6, high = 2.8;  // along the line
            for (int i = 0; i < 60; ++i) {
                const double x = 0.5 * (low + high);
                (project(camera, T_WC.inverse() * Vector3d(x, y, 0.0))->y() < row ? high : low) = x;
            }
            return Eigen::Vector2d(low, project(camera, T_WC.inverse() * Vector3d(low, y, 0.0))->x());
        };
        const Eigen::Vector2d outer = crossing(2.025);
        const Eigen::Vector2d inner = crossing(1.975);
        if (outer.x() < 0.2 || inner.x() > 1.9) continue;  // other lines are near
        const double far = outer.y();
        const double near = inner.y();
        const int before = static_cast<int>(std::floor(std::min(far, near))) - 4;
        const int after = static_cast<int>(std::ceil(std::max(far, near))) + 4;
        if (before < 0 || after >= camera.width || after - before > 200) continue;
        ++rows;
        EXPECT_NEAR(covered_in_row(image, row, before, after, 240.0, 60.0), std::abs(far - near), 0.05)
            << row;
        const int middle = static_cast<int>(std::lround(0.5 * (far + near)));
        EXPECT_NEAR(middle + 0.5 + covered_in_row(image, row, middle + 1, after, 240.0, 60.0),
                    std::max(far, near), 0.05)
            << row;
    }
    EXPECT_GT(rows, 50);
}

TEST_F(MovingCamera, ExposureTurnsAnEdgeIntoABoxAboutItsMiddle) {
    stand(1.0);
    formation.shutter.exposure = 0.02;
    for (const double rate : {0.4, 0.8, -1.2}) {
        motion.turn_rate = Vector3d(0.0, rate, 0.0);
        expect_edges(200, 235, 20, 0.02);
        const YuyvImage image = shoot();
        const int row = 220;
        const double middle = edge(motion.T_WC, true, row);
        const double length = std::abs(edge(motion.at(0.01), true, row) - edge(motion.at(-0.01), true, row));
        EXPECT_NEAR(length, camera.fx * std::abs(rate) * 0.02, 0.02 * length);
        // Second moment of the edge's derivative: a box of that length, and one of a pixel.
        const int first = static_cast<int>(middle) - 20;
        double mean = 0.0, square = 0.0;
        for (int x = first; x < first + 40; ++x) {
            const double step = (image.view().at(x + 1, row).y - image.view().at(x, row).y) / (goal - wall);
            mean += step * (x + 0.5);
            square += step * (x + 0.5) * (x + 0.5);
        }
        EXPECT_NEAR(mean, middle, 0.03) << rate;
        EXPECT_NEAR(square - mean * mean, (length * length + 1.0) / 12.0,
                    0.02 * length * length / 12.0 + 0.09)
            << rate;
    }
}

TEST_F(MovingCamera, ExposureAndReadoutWorkTogether) {
    formation.shutter.exposure = 0.01;
    formation.shutter.readout = 0.025;
    stand(1.5, 5 * degree);
    motion.turn_rate = Vector3d(0.3, 0.9, -0.6);
    motion.velocity = Vector3d(0.2, 0.25, -0.1);
    expect_edges(115, 225, 15, 0.03);
}

TEST_F(MovingCamera, LensesBendTheSameWayWhileMoving) {
    // The same world seen twice: turning about the optical axis moves nothing at the centre, and a frame of a
    // moving camera is, row by row, the frame of a still one at that row's pose.
    camera.distortion = {-0.12, 0.03, 0.001, 0.0, 0.0};
    formation.shutter.readout = 0.03;
    stand(1.5);
    motion.turn_rate = Vector3d(0.5, 1.0, 0.8);
    motion.velocity = Vector3d(0.1, 0.3, 0.0);
    const YuyvImage moving = shoot();
    Renderer renderer(make_scene(field, scene), camera, formation);
    for (const int row : {20, 133, 240, 301, 460}) {
        Random random(1);
        const YuyvImage still =
            renderer.render(test::still(motion.at(row_time(formation.shutter, row, camera.height))), random);
        int worst = 0;
        for (int x = 0; x < camera.width; ++x)
            worst = std::max(worst, std::abs(moving.view().at(x, row).y - still.view().at(x, row).y));
        EXPECT_LE(worst, 5) << row;  // 0.02 px of the strongest edge
    }
}

TEST_F(MovingCamera, NoMovementIsThePlainFrame) {
    stand(1.5);
    formation.sensor = {};
    const YuyvImage plain = shoot();
    formation.shutter = {.exposure = 0.01, .readout = 0.025};
    EXPECT_EQ(shoot().data, plain.data);
    // Nor does a movement of no time.
    formation.shutter = {};
    motion.turn_rate = Vector3d(0.0, 1.0, 0.0);
    EXPECT_EQ(shoot().data, plain.data);
    // The smallest movement goes the long way round and ends at the same frame but for roundings.
    formation.shutter = {.exposure = 0.01, .readout = 0.025};
    motion.turn_rate = Vector3d(0.0, 1e-9, 0.0);
    const YuyvImage slow = shoot();
    int worst = 0;
    for (std::size_t i = 0; i < slow.data.size(); ++i)
        worst = std::max(worst, std::abs(static_cast<int>(slow.data[i]) - static_cast<int>(plain.data[i])));
    EXPECT_LE(worst, 1);
}

TEST_F(MovingCamera, SameShotSameBytes) {
    stand(2.0);
    formation.sensor = {};
    formation.shutter = {.exposure = 0.01, .readout = 0.025};
    motion.turn_rate = Vector3d(0.3, 0.5, 0.2);
    Renderer renderer(make_scene(field, {}), camera, formation);
    const auto frame = [&](const CameraMotion& m) {
        Random random(5);
        return renderer.render({m}, random).data;
    };
    const auto first = frame(motion);
    CameraMotion other;
    other.T_WC = camera_at(0.0, 0.0, 2.0, 0.42, 0.1, 0.2);
    other.velocity = Vector3d(1.0, 0.0, 0.0);
    EXPECT_NE(frame(other), first);
    EXPECT_EQ(frame(motion), first);
}

TEST(CameraMotion, TurnsInItsOwnFrameAndMovesInTheWorld) {
    CameraMotion motion;
    motion.T_WC = camera_at(1.0, 2.0, 0.7, 0.4, 0.1, 0.2);
    motion.velocity = Vector3d(0.3, -0.2, 0.1);
    motion.turn_rate = Vector3d(0.5, -1.0, 2.0);
    EXPECT_TRUE(motion.at(0.0).isApprox(motion.T_WC));
    const Eigen::Isometry3d later = motion.at(0.4);
    EXPECT_TRUE(later.translation().isApprox(motion.T_WC.translation() + 0.4 * motion.velocity));
    const Vector3d turned = 0.4 * motion.turn_rate;
    const Eigen::Matrix3d expected =
        motion.T_WC.linear() * Eigen::AngleAxisd(turned.norm(), turned.normalized()).toRotationMatrix();
    EXPECT_TRUE(later.linear().isApprox(expected));
    EXPECT_TRUE(CameraMotion{}.still());
    EXPECT_FALSE(motion.still());
}

TEST(ShutterSampling, OneSampleAPixelAndBandsThatStayWithinHalfOne) {
    EXPECT_EQ(shutter_sampling({.exposure = 0.01, .readout = 0.0}, 480, 600.0, 0.0).samples, 6);
    EXPECT_EQ(shutter_sampling({.exposure = 0.01, .readout = 0.0}, 480, 600.0, 1.0).samples, 3);
    EXPECT_EQ(shutter_sampling({.exposure = 0.01, .readout = 0.0}, 480, 600.0, 0.3).samples, 6);
    EXPECT_EQ(shutter_sampling({.exposure = 0.01, .readout = 0.0}, 480, 1.0, 0.0).samples, 2);
    EXPECT_EQ(shutter_sampling({.exposure = 0.01, .readout = 0.0}, 480, 1e5, 0.0).samples, 16);
    EXPECT_EQ(shutter_sampling({.exposure = 0.0, .readout = 0.03}, 480, 1e5, 0.0).samples, 1);
    EXPECT_EQ(shutter_sampling({.exposure = 0.0, .readout = 0.03}, 480, 10.0, 0.0).band_rows, 16);
    EXPECT_EQ(shutter_sampling({.exposure = 0.0, .readout = 0.0479}, 480, 2000.0, 0.0).band_rows, 5);
    EXPECT_EQ(shutter_sampling({.exposure = 0.0, .readout = 0.03}, 480, 1e6, 0.0).band_rows, 1);
}

TEST(ImageSpeed, IsTheFlowOfTheFastestPixel) {
    const Intrinsics camera;
    CameraMotion motion;
    motion.T_WC = camera_at(0.0, 0.0, 0.0, 0.42, 0.0, 0.0);
    motion.turn_rate = Vector3d(0.0, 0.0, 2.0);  // about the axis: the corners are fastest
    const double corner = std::hypot(319.5, 239.5);
    EXPECT_NEAR(image_speed(camera, motion, 5.0), 2.0 * corner, 1e-6);
    motion.turn_rate.setZero();
    motion.velocity = Vector3d(0.0, 1.0, 0.0);  // sideways: things at 0.5 m, and the ground at the lower rim
    EXPECT_NEAR(image_speed(camera, motion, 0.5), camera.fx / 0.5, 1e-6);
    EXPECT_NEAR(image_speed(camera, motion, 50.0), camera.fx * (239.5 / camera.fy) / 0.42, 1e-6);
}

}  // namespace
}  // namespace goalmouth
