#pragma once

#include "core/imaging/capture_buffer.h"
#include "core/imaging/frame_clock.h"
#include "core/messaging/camera_info_output.h"
#include "core/messaging/image_output.h"
#include "core/parameters/parameters.h"
#include "core/process/module.h"
#include "core/simulation/simulation.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace goalmouth {

struct SimulatorParameters {
    std::string camera;
    std::string field;
    std::string scene;
    std::string camera_name = "simulator";
    double frames_per_second = 30.0;
    bool realtime = true;
    double start_time = 0.0;
    int frames = 0;
    double linger = 1.0;
    WalkParameters walk;
    KinematicsParameters kinematics;
};

template <class Visitor>
void describe_parameters(Visitor& v, SimulatorParameters& p) {
    v("camera", p.camera, File{.may_be_empty = true}, "calibration; empty: a Logitech C905 at 640x480");
    v("field", p.field, File{.may_be_empty = true}, "field and goals; empty: KidSize 2013");
    v("scene", p.scene, File{.may_be_empty = true},
      "what stands in the hall, how it is lit and what the camera makes of it; empty: defaults");
    v("camera_name", p.camera_name, Text{}, "name of the camera in messages");
    v("frames_per_second", p.frames_per_second, Range{0.1, 1000}, "1/s", "rate of the frames");
    v("realtime", p.realtime,
      "paced by the clock, leaving out frames it is too late for; false: as fast as can be");
    v("start_time", p.start_time, Range{0, 1e10}, "s",
      "capture time of the first frame since 1970 UTC; 0: now");
    v("frames", p.frames, Range{0, 2e9}, "1", "frames to send before it ends; 0: without end");
    v("linger", p.linger, Range{0, 60}, "s",
      "how long the pixels of the last frame stay readable after that");
    v.group("walk", p.walk, "how the robot walks");
    v.group("kinematics", p.kinematics, "how badly the robot knows where its camera is");
}

/// A robot that walks on a field and publishes what it sees, counts and measures, and the truth beside it.
class SimulatorModule : public Module {
  public:
    using Parameters = SimulatorParameters;

    static ModuleInfo info();
    SimulatorModule(ModuleContext& context, const Parameters& parameters);

    std::chrono::microseconds tick() override;
    bool finished() const override;

  private:
    using Clock = std::chrono::steady_clock;

    void start();
    void prepare();
    void send();
    std::chrono::microseconds since_start() const;

    ModuleContext& context_;
    Parameters parameters_;
    Simulation simulation_;
    ImageOutput output_;
    CameraInfoOutput info_output_;

    std::optional<FrameClock> clock_;  // from the first tick on
    Clock::time_point started_{};
    bool prepared_ = false;  // the next frame is rendered and waits for its time
    std::int64_t time_ = 0;  // its number on the clock
    std::int64_t seq_ = 0;   // its number among the frames sent
    SimulatedFrame frame_;
    CaptureBuffer buffer_{&output_};
    Captured image_;  // its pixels
    std::optional<Clock::time_point> end_;
};

}  // namespace goalmouth
