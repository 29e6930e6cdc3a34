#include "tests/bench/machine.h"

#include "core/process/configuration.h"
#include "core/process/text.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <hwy/highway.h>
#include <sys/utsname.h>
#include <thread>

#include <Eigen/Core>
#include <opencv2/core/utility.hpp>

namespace goalmouth::bench {
namespace {

/// The value of "key : value" or KEY="value" in a file of the system.
std::string value_in(const char* file, const std::string& key, char separator) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (!line.starts_with(key)) continue;
        const auto at = line.find(separator);
        if (at == std::string::npos) continue;
        std::string value = line.substr(at + 1);
        std::erase(value, '"');
        const auto first = value.find_first_not_of(" \t");
        return first == std::string::npos ? std::string() : value.substr(first);
    }
    return {};
}

/// The largest cache of the first processor.
std::size_t largest_cache() {
    std::size_t largest = 0;
    std::error_code ignored;
    for (const auto& entry :
         std::filesystem::directory_iterator("/sys/devices/system/cpu/cpu0/cache", ignored)) {
        std::ifstream in(entry.path() / "size");
        std::size_t kibibytes = 0;
        if (in >> kibibytes) largest = std::max(largest, kibibytes << 10);
    }
    return largest;
}

std::string kernel() {
    utsname names{};
    return ::uname(&names) == 0 ? fmt::format("{} {} {}", names.sysname, names.release, names.machine)
                                : std::string();
}

std::string compiler() {
#if defined(__clang__)
    return "clang " __clang_version__;
#elif defined(__GNUC__)
    return "g++ " __VERSION__;
#else
    return "?";
#endif
}

/// Better ones have lower bits.
std::vector<std::int64_t> targets() {
    std::vector<std::int64_t> bits;
    const std::int64_t usable = hwy::SupportedTargets() & HWY_TARGETS;
    for (int i = 0; i < 62; ++i)
        if ((usable >> i & 1) != 0) bits.push_back(std::int64_t{1} << i);
    return bits;
}

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

}  // namespace

Machine this_machine() {
    Machine machine;
    machine.processor = value_in("/proc/cpuinfo", "model name", ':');
    if (machine.processor.empty()) machine.processor = value_in("/proc/cpuinfo", "Hardware", ':');
    machine.processors = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    machine.last_level_cache = largest_cache();
    machine.system = value_in("/etc/os-release", "PRETTY_NAME", '=') + ", " + kernel();
    machine.simd = targets().empty() ? "none" : hwy::TargetName(targets().front());
    machine.opencv_features = cv::getCPUFeaturesLine();
    machine.compiler = compiler();
    machine.versions = {
        {"goalmouth", GOALMOUTH_VERSION},
        {"OpenCV", CV_VERSION},
        {"Highway", fmt::format("{}.{}.{}", HWY_MAJOR, HWY_MINOR, HWY_PATCH)},
        {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}};
    return machine;
}

void restrict_simd(const std::string& name) {
    std::vector<std::string> names;
    for (const std::int64_t bit : targets()) {
        names.emplace_back(hwy::TargetName(bit));
        if (lower(names.back()) != lower(name)) continue;
        hwy::SetSupportedTargetsForTest(hwy::SupportedTargets() & ~(bit - 1));
        return;
    }
    throw ConfigurationError("--simd: this processor has no '" + name + "' that our code uses; " +
                             suggestion(name, names));
}

}  // namespace goalmouth::bench
