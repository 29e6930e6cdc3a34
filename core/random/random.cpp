#include "core/random/random.h"

#include <cmath>
#include <numbers>

namespace goalmouth {
namespace {

/// splitmix64: spreads any seed, 0 included, over the whole state.
std::uint64_t spread(std::uint64_t& seed) {
    std::uint64_t z = (seed += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
}

/// 64-bit FNV-1a.
std::uint64_t hash(std::string_view text) {
    std::uint64_t h = 0xcbf29ce484222325U;
    for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return h;
}

}  // namespace

Random::Random(std::uint64_t seed) {
    for (auto& word : state_) word = spread(seed);
}

double Random::uniform() {
    return static_cast<double>(bits() >> 11) * 0x1.0p-53;
}

double Random::uniform(double lowest, double highest) {
    return lowest + (highest - lowest) * uniform();
}

double Random::normal() {
    if (has_spare_) {
        has_spare_ = false;
        return spare_;
    }
    // Box–Muller; 1 − uniform() keeps the logarithm finite.
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    const double angle = 2.0 * std::numbers::pi * uniform();
    spare_ = radius * std::sin(angle);
    has_spare_ = true;
    return radius * std::cos(angle);
}

Random random_for_frame(std::uint64_t graph_seed, std::string_view module, std::int64_t frame_seq) {
    std::uint64_t seed = graph_seed;
    std::uint64_t mixed = spread(seed) ^ hash(module);
    mixed = spread(mixed) ^ static_cast<std::uint64_t>(frame_seq);
    return Random(spread(mixed));
}

}  // namespace goalmouth
