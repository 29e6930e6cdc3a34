#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace goalmouth {

/// xoshiro256++ (Blackman and Vigna), with distributions of our own: the standard's differ between libraries,
/// and a replay on another machine must draw the same numbers.
class Random {
  public:
    explicit Random(std::uint64_t seed);

    std::uint64_t bits();
    /// Uniform in [0, 1), 53 bits.
    double uniform();
    /// Uniform in [lowest, highest).
    double uniform(double lowest, double highest);
    /// Uniform in 0 … count−1, without modulo bias; count ≥ 1.
    std::uint32_t index(std::uint32_t count);
    /// Normal with mean 0 and standard deviation 1.
    double normal();

  private:
    static void step(std::uint64_t& a, std::uint64_t& b, std::uint64_t& c, std::uint64_t& d);

    std::uint64_t state_[4];
    double spare_ = 0.0;
    bool has_spare_ = false;
};

// Inline, so that a loop of draws keeps the state in registers.
inline void Random::step(std::uint64_t& a, std::uint64_t& b, std::uint64_t& c, std::uint64_t& d) {
    const std::uint64_t t = b << 17;
    c ^= a;
    d ^= b;
    b ^= c;
    a ^= d;
    c ^= t;
    d = std::rotl(d, 45);
}

inline std::uint64_t Random::bits() {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    step(state_[0], state_[1], state_[2], state_[3]);
    return result;
}

inline std::uint32_t Random::index(std::uint32_t count) {
    // Lemire's multiply-and-reject.
    std::uint64_t product = (bits() >> 32) * count;
    auto low = static_cast<std::uint32_t>(product);
    if (low < count) {
        const std::uint32_t threshold = (0U - count) % count;
        while (low < threshold) {
            product = (bits() >> 32) * count;
            low = static_cast<std::uint32_t>(product);
        }
    }
    return static_cast<std::uint32_t>(product >> 32);
}

/// The generator of one module for one frame: every draw in the graph is a function of these three.
Random random_for_frame(std::uint64_t graph_seed, std::string_view module, std::int64_t frame_seq);

}  // namespace goalmouth
