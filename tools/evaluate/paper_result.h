#pragma once

#include "tools/evaluate/paper_run.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace goalmouth {

/// What `goalmouth evaluate paper` was asked for, as the command line gives it.
struct PaperOptions {
    int frames_per_cell = 200;
    std::string size = "640x480";
    std::string detectors = "histogram,ransac";  // names in config/graphs or graph files
    std::string scenes = "flat";                 // names in config/evaluation or files
    std::uint64_t seed = 1;
    std::vector<std::string> settings;  // "PROCESS.KEY=VALUE"
    std::string field;                  // "": the KidSize field of 2013
    std::string camera;                 // "": the C905
    std::string colours;                // "": as the graphs say
};

/// A run, or part of one, with all that is needed to know what it is a run of.
struct PaperResult {
    std::string version;  // of goalmouth
    std::string command;
    PaperOptions options;
    std::vector<std::string> scenes;     // names
    std::vector<std::string> detectors;  // names
    nlohmann::ordered_json settings;     // every parameter of field, camera, scenes and detectors
    std::optional<Shard> shard;          // nothing: the whole
    bool complete = true;                // every frame of the whole, or of the shard, is there
    std::vector<FrameRecord> records;    // by running number
};

/// The file: header, rule, the paper's figures, cells, tilts, and a row of numbers for each frame and
/// detector, from which the figures can be worked out again to the last bit.
std::string paper_json(const PaperResult& result);

/// Reads such a file back. Throws ConfigurationError, which begins with the file's name, for anything else.
PaperResult read_paper_json(const std::filesystem::path& file);

}  // namespace goalmouth
