#pragma once

#include "core/random/random.h"

#include <cstddef>
#include <cstdint>

namespace goalmouth {

/// `pairs` times index(count) and index(count − 1), one behind the other in `indices`, from the same draws
/// and leaving the generator as those calls do; count ≥ 2. `indices` needs room for 8 numbers more.
///
/// The generator's state goes on step by step, but all that makes an index of it is done for several at once.
void draw_index_pairs(Random& random, std::uint32_t count, std::size_t pairs, std::uint64_t* indices);

}  // namespace goalmouth
