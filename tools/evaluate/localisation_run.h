#pragma once

#include "core/field/field.h"
#include "core/geometry/camera.h"
#include "core/simulation/simulation.h"
#include "tools/evaluate/localisation_data.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace goalmouth {

struct LocalisationDetector {
    std::string name;
    std::string graph;                  // a file, or a name in config/graphs; it has a localisation
    std::vector<std::string> settings;  // "PROCESS.KEY=VALUE"
};

struct LocalisationOptions {
    int runs = 100;
    std::vector<LocalisationDetector> detectors;
    std::uint64_t seed = 1;
    int jobs = 1;
    double seconds = 0.0;  // 0: until the robot is at the ball
    double frames_per_second = 30.0;
    int part = 1;  // of `parts`: the runs ≡ part − 1 modulo parts
    int parts = 1;
    SimulationParameters simulation;
    Field field;
    Intrinsics camera;
    std::string scene;                 // name, for people
    std::filesystem::path field_file;  // for the graphs; "": as each says
    std::filesystem::path colours;     // for the graphs; "": as each says
};

struct LocalisationProgress {
    std::function<void(std::size_t frames)> expect;  // in all; before the first
    std::function<void()> step;                      // after each frame; from any thread
    std::function<bool()> stop;                      // runs under way end after their frame and are left out
};

/// Time the paper's walk takes: from the side line to where the route is nearest to the penalty mark of that
/// half. Throws ConfigurationError where the robot stands still.
double walk_to_ball_seconds(const WalkParameters& walk, const Field& field);

/// The paper's walk again and again. Each run has random numbers of its own, from the seed and its number
/// alone; its frames are rendered once and go to the graph of every detector, made anew for the run, together
/// with odometry and kinematics. Throws ConfigurationError, and std::runtime_error where a graph leaves a
/// frame without a pose.
LocalisationResult evaluate_localisation(const LocalisationOptions& options,
                                         const LocalisationProgress& progress = {});

}  // namespace goalmouth
