#pragma once

#include "core/imaging/frame_clock.h"
#include "tests/bench/graph/pacing.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

namespace goalmouth {
class Bus;
class LcmBus;
}  // namespace goalmouth

namespace goalmouth::bench {

/// What a robot that stands still says of itself with each cycle of its joint control, every 8 ms as
/// DARwIn-OP's, whatever the camera does: KINEMATICS with the head 0.42 m above the ground and tilted down by
/// 10°, ODOMETRY without a step.
class StandingRobot {
  public:
    StandingRobot();

    Clock::time_point due() const;
    /// Publishes what is due by now.
    void speak(Bus& bus);

  private:
    FrameClock clock_;
    Clock::time_point start_;
    std::int64_t next_ = 0;
};

/// The same in a thread of its own, over LCM.
class StandingRobotProcess {
  public:
    explicit StandingRobotProcess(const std::string& lcm_url);
    ~StandingRobotProcess();
    StandingRobotProcess(const StandingRobotProcess&) = delete;
    StandingRobotProcess& operator=(const StandingRobotProcess&) = delete;

  private:
    std::unique_ptr<LcmBus> bus_;
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

}  // namespace goalmouth::bench
