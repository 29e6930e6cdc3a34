#pragma once

#include "core/field/field.h"
#include "core/geometry/camera.h"
#include "core/random/random.h"
#include "core/simulation/exposure.h"
#include "core/simulation/image_formation.h"
#include "core/simulation/renderer.h"
#include "core/simulation/scene.h"
#include "core/simulation/truth.h"
#include "core/simulation/walker.h"

#include <cstddef>
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace goalmouth {

struct SimulationParameters {
    ImageFormationParameters formation;
    WalkParameters walk;
    KinematicsParameters kinematics;
};

/// All that goes with one frame but its pixels.
struct SimulatedFrame {
    Truth truth;
    Pose2 odometry;                                          // as the robot counted it
    Eigen::Isometry3d T_BC = Eigen::Isometry3d::Identity();  // as the robot measured it
    Eigen::Matrix<double, 6, 6> T_BC_covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// A robot that walks about a field and sees it.
class Simulation {
  public:
    /// `run`: what belongs to the run as a whole is drawn from it. Throws std::invalid_argument on impossible
    /// parameters.
    Simulation(const SimulationParameters& parameters, const Field& field, const Intrinsics& camera,
               const Random& run);

    /// The robot walks on until `time` [s], which never runs backwards, and takes a frame: height rows of
    /// `stride` bytes of YUYV at `out`. All noise of the frame comes from `frame`.
    SimulatedFrame capture(double time, Random& frame, std::uint8_t* out, std::ptrdiff_t stride);

    const Intrinsics& camera() const { return renderer_.camera(); }
    const Scene& scene() const { return renderer_.scene(); }

  private:
    Renderer renderer_;
    Walker walker_;
    KinematicsModel kinematics_;
    Exposure exposure_;
};

}  // namespace goalmouth
