#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace goalmouth::bench {

/// What the figures were measured on and with.
struct Machine {
    std::string processor;
    int processors = 0;
    std::size_t last_level_cache = 0;  // bytes; 0: the system does not say
    std::string system;
    std::string simd;             // what our code uses
    std::string opencv_features;  // what OpenCV may use
    std::string compiler;
    std::vector<std::pair<std::string, std::string>> versions;
};

Machine this_machine();

/// Our code as on a processor without what is better than `name`, a name of Highway's ("AVX2"). Before it has
/// run. Throws ConfigurationError where the processor has no such thing, with what it has.
void restrict_simd(const std::string& name);

}  // namespace goalmouth::bench
