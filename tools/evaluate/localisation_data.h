#pragma once

#include "core/field/field.h"
#include "core/geometry/pose2.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace goalmouth {

/// How far an estimate is from the truth, and how far the filter believes it may be.
struct PoseQuality {
    double position_error = 0.0;  // m
    double heading_error = 0.0;   // rad, ≥ 0
    double position_sigma = 0.0;  // m, root of the trace of the covariance of x and y
    double heading_sigma = 0.0;   // rad
};

/// What one detector's localisation made of one walk.
struct DetectorWalk {
    PoseQuality walk;                // means over every frame
    PoseQuality end;                 // means over the frames of the last second
    int posts = 0;                   // found in all frames together
    std::vector<Pose2> path;         // estimated, at the run's times
    std::vector<PoseQuality> track;  // at the run's times
};

struct LocalisationRun {
    int run = 0;
    int frames = 0;
    std::vector<double> times;            // s since the start, a few a second
    std::vector<Pose2> truth;             // at these times
    std::vector<DetectorWalk> detectors;  // as LocalisationResult::detectors
};

/// What a run counts as lost: its last second is further off than this.
inline constexpr double lost_beyond = 0.5;  // m

struct LocalisationResult {
    // The same in all shards of one evaluation.
    std::uint64_t seed = 1;
    int runs = 0;  // asked for
    std::vector<std::string> detectors;
    double seconds = 0.0;
    double frames_per_second = 0.0;
    std::string scene;        // name, for people
    nlohmann::json settings;  // every parameter of simulation and graphs that was set
    Field field;

    std::string shard;  // "I/N", or "" for the whole
    std::string command;
    std::string version;
    std::vector<LocalisationRun> done;  // by run

    bool complete() const;  // for the whole: every run is there
};

/// The document that `--json` writes: the settings, the figures for each detector (summarise()), and every
/// run. Samples over time are rounded to 0.1 mm and 0.1 mrad, so that what is read back draws the same
/// figures.
nlohmann::ordered_json localisation_json(const LocalisationResult& result);

/// Throws ConfigurationError naming `file` where it is no such document.
LocalisationResult read_localisation_json(const nlohmann::json& document, const std::filesystem::path& file);

/// Joins shards of one evaluation. Throws ConfigurationError naming the files where they are of different
/// evaluations or two hold the same run.
LocalisationResult join_localisation(const std::vector<std::filesystem::path>& files);

/// 0.1 mm or 0.1 mrad.
double rounded(double value);

}  // namespace goalmouth
