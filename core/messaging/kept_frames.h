#pragma once

#include "core/messaging/image_input.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include <goalmouth/intrinsics_t.hpp>

namespace goalmouth {

/// The last few frames that came, for a module that looks at their pixels once it has heard what others found
/// in them. Frames in a ring are kept where they stand, without a copy: ask still_valid() after use, as ever.
/// Pixels of a message are copied, those of a JPEG shared.
class KeptFrames {
  public:
    explicit KeptFrames(std::size_t most) : most_(most) {}

    void keep(const Frame& frame);
    /// The frame kept last that has this time, number and calibration; nullptr where there is none. Several
    /// cameras may come on one channel. Valid until the next keep().
    const Frame* find(std::int64_t utime, std::int64_t seq, const intrinsics_t& intrinsics) const;

  private:
    struct Kept {
        Frame frame;
        std::vector<std::uint8_t> pixels;  // where they are nobody else's
    };

    std::size_t most_;
    std::deque<Kept> frames_;  // the oldest first
};

}  // namespace goalmouth
