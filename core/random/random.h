#pragma once

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
    std::uint64_t state_[4];
    double spare_ = 0.0;
    bool has_spare_ = false;
};

/// The generator of one module for one frame: every draw in the graph is a function of these three.
Random random_for_frame(std::uint64_t graph_seed, std::string_view module, std::int64_t frame_seq);

}  // namespace goalmouth
