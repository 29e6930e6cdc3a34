#include "tests/bench/graph/standing_robot.h"

#include "core/conversion/camera_pose.h"
#include "core/conversion/odometry.h"
#include "core/messaging/channels.h"
#include "core/messaging/clock.h"
#include "core/messaging/lcm_bus.h"
#include "core/messaging/signals_blocked.h"
#include "core/messaging/typed.h"

#include <goalmouth/kinematics_t.hpp>
#include <goalmouth/odometry_t.hpp>

namespace goalmouth::bench {
namespace {

constexpr double cycles_per_second = 125.0;
constexpr double camera_height = 0.42;  // m
constexpr double camera_tilt = 0.17;    // rad
constexpr std::int64_t no_frame = -1;

kinematics_t kinematics_at(std::int64_t utime) {
    Eigen::Matrix3d forward;  // x right, y down, z forward → x forward, y left, z up
    forward << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    Eigen::Isometry3d T_BC = Eigen::Isometry3d::Identity();
    T_BC.translation() = Eigen::Vector3d(0.0, 0.0, camera_height);
    T_BC.linear() = Eigen::AngleAxisd(camera_tilt, Eigen::Vector3d::UnitY()).toRotationMatrix() * forward;
    return kinematics_message(T_BC, utime, no_frame);
}

odometry_t odometry_at(std::int64_t utime, std::int64_t seq) {
    OdometrySample sample;
    sample.utime = utime;
    return to_message(sample, seq);
}

}  // namespace

StandingRobot::StandingRobot() : clock_(now_utime(), cycles_per_second), start_(Clock::now()) {}

Clock::time_point StandingRobot::due() const {
    return start_ + clock_.after_start(next_);
}

void StandingRobot::speak(Bus& bus) {
    while (due() <= Clock::now()) {
        const std::int64_t utime = clock_.utime(next_);
        publish(bus, channels::kinematics, kinematics_at(utime));
        publish(bus, channels::odometry, odometry_at(utime, next_));
        ++next_;
    }
}

StandingRobotProcess::StandingRobotProcess(const std::string& lcm_url)
    : bus_(std::make_unique<LcmBus>(lcm_url)) {
    const SignalsBlocked blocked;
    thread_ = std::thread([this] {
        StandingRobot robot;
        while (!stop_) {
            sleep_until(robot.due());
            robot.speak(*bus_);
        }
    });
}

StandingRobotProcess::~StandingRobotProcess() {
    stop_ = true;
    thread_.join();
}

}  // namespace goalmouth::bench
