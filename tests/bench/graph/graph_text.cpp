#include "tests/bench/graph/graph_text.h"

#include "core/process/paths.h"

#include <fmt/format.h>
#include <fstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace goalmouth::bench {
namespace {

namespace fs = std::filesystem;

std::string quoted(const fs::path& path) {
    return nlohmann::json(path.string()).dump();  // which YAML takes as well
}

fs::path given_or(const fs::path& given, const char* otherwise) {
    return given.empty() ? config_folder() / otherwise : fs::absolute(given);
}

std::string entry(const GraphBenchOptions& options, const std::string& name, const std::string& program) {
    const fs::path file =
        options.programs_folder.empty() ? fs::path(program) : fs::absolute(options.programs_folder) / program;
    return "  - name: " + name + "\n    executable: " + quoted(file) + "\n";
}

}  // namespace

std::string graph_text(const GraphBenchOptions& options, Pixels pixels) {
    const bool ring = pixels == Pixels::ring;
    std::string text = "name: bench\n";
    text += fmt::format("seed: {}\n", options.seed);
    text += std::string("external: [") + (ring ? "" : "IMAGE, IMAGE_TAP, ") + "ODOMETRY, KINEMATICS]\n";
    text += "common:\n";
    text += "  field: " + quoted(field_file(options)) + "\n";
    text += "  colours: " + quoted(colours_file(options)) + "\n";
    if (ring && !options.assume_camera) text += "  camera: " + quoted(camera_file(options)) + "\n";
    text += "processes:\n";
    if (ring) {
        text += entry(options, "camera", "camera") + "    parameters:\n" +
                fmt::format(
                    "      source: directory\n      path: {}\n      loop: true\n      width: {}\n"
                    "      height: {}\n      frames_per_second: {}\n      start_time: 0\n",
                    quoted(fs::absolute(options.frames_folder)), options.width, options.height,
                    options.frames_per_second);
    }
    text += entry(options, "segmentation", "segmentation") +
            fmt::format(
                "    parameters:\n      scan_lines:\n        row_spacing: {0}\n        column_spacing: {0}\n",
                graph_spacing);
    text += entry(options, "extraction", "extraction");
    text += entry(options, "detection", "detection_ransac");
    text += entry(options, "localisation", "localisation");
    return text;
}

fs::path field_file(const GraphBenchOptions& options) {
    return given_or(options.field, "fields/kidsize_2013.yaml");
}

fs::path colours_file(const GraphBenchOptions& options) {
    return given_or(options.colours, "colours/simulator.gmct");
}

fs::path camera_file(const GraphBenchOptions& options) {
    return given_or(options.camera, "cameras/c905.yaml");
}

GraphFileOnDisk::GraphFileOnDisk(const std::string& text) {
    std::ofstream file(path());
    if (!(file << text << std::flush))
        throw std::runtime_error("the file " + path().string() + " cannot be written");
}

}  // namespace goalmouth::bench
