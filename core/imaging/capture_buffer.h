#pragma once

#include "core/imaging/frame_memory.h"
#include "core/imaging/source.h"

#include <span>
#include <vector>

namespace goalmouth {

/// Memory for one image after the other, to be decoded or read into: of a FrameMemory where there is one and
/// it has room, else of its own.
class CaptureBuffer {
  public:
    explicit CaptureBuffer(FrameMemory* memory) : memory_(memory) {}

    /// Memory for 4:2:2 pixels, rows packed, and `frame` as their description; its time stays. What the last
    /// call gave is given up.
    std::span<std::uint8_t> prepare(Captured& frame, int width, int height);

  private:
    FrameMemory* memory_;
    std::vector<std::uint8_t> own_;
};

}  // namespace goalmouth
