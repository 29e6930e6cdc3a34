#pragma once

#include "core/localisation/particle.h"
#include "core/random/random.h"

#include <cstddef>
#include <vector>

namespace goalmouth {

/// 1 / Σ w², for weights that sum to 1: between 1 (one particle holds all) and their number. 0 without
/// particles.
double effective_sample_size(const Particles& particles);

/// Systematic (low variance) resampling: indices into `weights` (≥ 0, at least one > 0), ascending. One
/// uniform draw u places `count` pointers at (i + u)/count of the summed weight, so index j comes ⌊count·w_j⌋
/// or ⌈count·w_j⌉ times, count·w_j on average; and as the order is kept, a run of neighbours also gets its
/// share to within one. Source: Thrun, Burgard, Fox, Probabilistic Robotics, table 4.4.
std::vector<std::size_t> systematic_resample(const std::vector<double>& weights, std::size_t count,
                                             Random& random);

}  // namespace goalmouth
