#pragma once

#include "core/localisation/particle.h"

#include <cstdint>

#include <goalmouth/particles_t.hpp>

namespace goalmouth {

/// `utime` and `seq` are the pose's.
particles_t to_message(const Particles& particles, std::int64_t utime, std::int64_t seq);
Particles from_message(const particles_t& message);

}  // namespace goalmouth
