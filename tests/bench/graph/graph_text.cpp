#include "tests/bench/graph/graph_text.h"

#include "core/process/paths.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace goalmouth::bench {
namespace {

namespace fs = std::filesystem;

constexpr int spacing = 8;  // px

std::string quoted(const fs::path& path) {
    return nlohmann::json(path.string()).dump();  // which YAML takes as well
}

std::string entry(const GraphBenchOptions& options, const std::string& name, const std::string& program) {
    const fs::path file =
        options.programs_folder.empty() ? fs::path(program) : fs::absolute(options.programs_folder) / program;
    return "  - name: " + name + "\n    executable: " + quoted(file) + "\n";
}

}  // namespace

std::string graph_text(const GraphBenchOptions& options, Pixels pixels) {
    const fs::path config = config_folder();
    const bool ring = pixels == Pixels::ring;
    std::string text = "name: bench\n";
    text += fmt::format("seed: {}\n", options.seed);
    text += std::string("external: [") + (ring ? "" : "IMAGE, IMAGE_TAP, ") + "ODOMETRY, KINEMATICS]\n";
    text += "common:\n";
    text += "  field: " + quoted(config / "fields" / "kidsize_2013.yaml") + "\n";
    text += "  colours: " + quoted(config / "colours" / "simulator.gmct") + "\n";
    if (ring) text += "  camera: " + quoted(config / "cameras" / "c905.yaml") + "\n";
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
                spacing);
    text += entry(options, "extraction", "extraction");
    text += entry(options, "detection", "detection_ransac");
    text += entry(options, "localisation", "localisation");
    return text;
}

GraphFileOnDisk::GraphFileOnDisk(const std::string& text) {
    std::string name = (fs::temp_directory_path() / "goalmouth-bench-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
        throw std::runtime_error("the folder " + fs::temp_directory_path().string() +
                                 " cannot be written: " + std::strerror(errno));
    folder_ = name;
    std::ofstream(path()) << text;
}

GraphFileOnDisk::~GraphFileOnDisk() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

}  // namespace goalmouth::bench
