#pragma once

#include "core/messaging/bus.h"

#include <cstdint>
#include <optional>
#include <string>

#include <goalmouth/camera_info_t.hpp>

namespace goalmouth {

/// Says which camera sends: with its first frame, then once a second of capture time, for those who join
/// late.
class CameraInfoOutput {
  public:
    CameraInfoOutput(Bus& bus, std::string channel);

    /// To be called with each frame; `info.utime` is the frame's.
    void announce(const camera_info_t& info);

  private:
    Bus& bus_;
    std::string channel_;
    std::optional<std::int64_t> next_utime_;  // µs
};

}  // namespace goalmouth
