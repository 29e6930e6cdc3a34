#include "core/imaging/capture_buffer.h"

#include "core/imaging/reused_memory.h"
#include "core/imaging/yuyv.h"

namespace goalmouth {

std::span<std::uint8_t> CaptureBuffer::prepare(Captured& frame, int width, int height) {
    frame.format = PixelFormat::yuyv;
    frame.width = width;
    frame.height = height;
    frame.stride = yuyv_row_bytes(width);
    const auto bytes = static_cast<std::size_t>(frame.stride) * static_cast<std::size_t>(height);
    frame.slot = {};
    if (memory_ != nullptr) frame.slot = memory_->open(bytes);
    if (!frame.slot) fit(own_, bytes);
    const std::span<std::uint8_t> to = frame.slot ? frame.slot.bytes().first(bytes) : std::span(own_);
    frame.bytes = to;
    return to;
}

}  // namespace goalmouth
