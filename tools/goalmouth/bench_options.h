#pragma once

#include "core/imaging/image_file.h"

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace goalmouth {

/// What `goalmouth bench` can be asked for; the verb and the program goalmouth_bench read the same options.
struct BenchOptions {
    std::string json;
    std::string report;
    std::string only;  // "stages", "graph"; empty: both
    std::string sizes = "640x480,1600x1200";
    int frames = 0;  // of memory at each size; 0: least_frames, or more beyond the cache
    std::string images;
    std::string scene = "match";
    std::string field;
    std::string camera;
    std::string colours;
    int repetitions = 2;
    std::string simd;
    double seconds = 20.0;
    double frames_per_second = 30.0;
    std::uint64_t seed = 1;

    bool stages() const { return only != "graph"; }
    bool graph() const { return only != "stages"; }
};

/// Frames of memory that there must be at least for each to be out of the caches when its turn comes.
inline constexpr int least_frames = 120;

void add_bench_options(CLI::App& app, BenchOptions& options);

/// The sizes of a list "640x480,1600x1200". Throws ConfigurationError for what is none, or twice the same.
std::vector<ImageSize> bench_sizes(const std::string& list);

/// Refuses what contradicts itself. Throws ConfigurationError.
void check_bench_options(const BenchOptions& options);

/// The command line that asks for these options, defaults left out, without the program's name.
std::vector<std::string> bench_arguments(const BenchOptions& options);

}  // namespace goalmouth
