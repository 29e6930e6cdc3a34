#pragma once

#include "core/imaging/colour_gains.h"
#include "core/imaging/known_colours.h"

#include <cstdint>

#include <goalmouth/colour_gains_t.hpp>

namespace goalmouth {

/// `from_utime` [µs]: of the first frame the gains hold for.
colour_gains_t to_message(const ColourGains& gains, const KnownColours& known, std::int64_t utime,
                          std::int64_t seq, std::int64_t from_utime);
ColourGains from_message(const colour_gains_t& message);
KnownColours known_colours(const colour_gains_t& message);

}  // namespace goalmouth
