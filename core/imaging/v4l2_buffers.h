#pragma once

#include "core/imaging/frame_memory.h"
#include "core/imaging/v4l2_device.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace goalmouth {

/// The buffers a device fills: slots of a FrameMemory, where the driver takes memory of ours ("user
/// pointers"), so that an image is where its readers want it without a copy; else memory of the driver's.
///
/// A slot is open from when it is queued. The driver keeps what it knows of a piece of memory by the number
/// of the buffer, so each slot comes back under its own number where there are enough of them.
class V4l2Buffers {
  public:
    /// Both outlive this. Without `memory` the driver's own is used.
    V4l2Buffers(V4l2Device& device, FrameMemory* memory) : device_(device), memory_(memory) {}
    ~V4l2Buffers() { stop(); }
    V4l2Buffers(const V4l2Buffers&) = delete;
    V4l2Buffers& operator=(const V4l2Buffers&) = delete;

    /// Gives the open device `count` buffers for images of `image_bytes`, and starts streaming. A device that
    /// needs more gets more of its own memory: slots it would take from those that stay readable. Throws
    /// std::runtime_error.
    ///
    /// False where the driver took slots, then refused them, and would not let go of them: the device is
    /// closed, so that it writes there no more. Opened anew and set up, it is started without slots from then
    /// on.
    bool start(int count, std::size_t image_bytes);
    /// Closes the device, and only then, when it cannot write there any more, gives the slots back.
    void stop();

    /// Whether images come in slots.
    bool in_place() const { return in_place_; }
    /// Why the driver's own memory is used although there is a FrameMemory: "" or what the driver said. Also
    /// "" where the memory had no room at the start(), see lacks_room().
    const std::string& refusal() const { return refusal_; }
    bool lacks_room() const { return lacks_room_; }

    struct Filled {
        v4l2_buffer buffer{};
        std::span<const std::uint8_t> bytes;  // as many as the driver says it used, of those there are
        FrameSlot slot;                       // where in_place()
    };
    /// Takes a filled buffer. False with errno; EBADSLT where the driver names one it does not have.
    bool take(Filled& filled);
    /// Queues a buffer for each that was taken; the bytes of the driver's own then are its again. False with
    /// errno.
    bool refill();

  private:
    bool start_in_place(int count, std::size_t image_bytes);
    void start_mapped(int count);
    bool queue(FrameSlot slot);

    V4l2Device& device_;
    FrameMemory* memory_;
    bool in_place_ = false;
    bool lacks_room_ = false;
    bool keeps_slots_ = false;  // a driver that would not let go
    std::string refusal_;
    std::size_t image_bytes_ = 0;
    struct Buffer {
        FrameSlot slot;  // while the driver has it
        int last = -1;   // the slot it had last
    };
    std::vector<Buffer> buffers_;        // in place: by the driver's numbers
    int missing_ = 0;                    // in place: so many to queue
    std::optional<std::uint32_t> held_;  // mapped: the one taken last
};

}  // namespace goalmouth
