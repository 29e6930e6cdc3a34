#pragma once

#include "core/imaging/source.h"
#include "core/imaging/yuyv.h"
#include "core/messaging/bus.h"
#include "core/messaging/frame_ring.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include <goalmouth/intrinsics_t.hpp>

namespace goalmouth {

/// What goes with the pixels of a frame.
struct FrameInfo {
    std::int64_t utime = 0;        // µs, capture time
    std::int64_t seq = 0;          // frame number of this camera, from 0
    intrinsics_t intrinsics{};     // also says the image's size
    std::int32_t exposure_us = 0;  // 0 = unknown
    std::int32_t readout_us = 0;   // 0 = global shutter or unknown
};

/// The sending end of a camera: pixels into a ring of shared memory, a descriptor onto the bus.
///
/// Where /dev/shm has no room for the ring, that is said once, with the remedy, and tried again with each
/// frame; frames meanwhile are counted as missed. So it is for frames too large for the ring there is and for
/// any, above FrameRing::most_slot_bytes. Such a frame's descriptor is still sent, naming no ring
/// there is: it has readers let go of the ring of a camera that ended before, whose memory is perhaps what is
/// missing.
class ImageOutput : public FrameMemory {
  public:
    /// The ring has `slots` slots, 2 to 64. It is made with the first frame, and anew where a frame is larger
    /// than its slots; the smaller one stays where there is no room for a larger.
    ImageOutput(Bus& bus, std::string channel, std::string camera, int slots = 8);

    /// Memory in the ring for a frame of `bytes`: to be filled, and announced by publish() as what a Captured
    /// stands in. Empty where there is no room; publish() then makes another attempt and counts. Throws
    /// std::logic_error where all slots are open, or for a larger frame than the ring's while one is; its
    /// std::invalid_argument for 0 bytes, or a number of slots no ring has.
    FrameSlot open(std::size_t bytes) override;
    int slots() const override { return slots_; }

    /// Copies a frame into the ring and announces it. False where it was missed for want of memory.
    bool publish(const FrameInfo& info, const YuyvView& pixels);
    /// One or the other, as `image` (4:2:2) stands in a slot of this or not. Gives the slot up.
    bool publish(const FrameInfo& info, Captured& image);

    std::int64_t frames_in_place() const { return frames_in_place_; }  // announced without a copy
    std::int64_t copied_frames() const { return copied_frames_; }      // copied once, then announced
    std::int64_t missed_frames() const { return missed_frames_; }      // not announced for want of memory

    /// The three by their names in STATUS: all frames are the sum of them, and copies of a frame between
    /// where it was made and who reads it are copied_frames ÷ (frames_in_place + copied_frames).
    using Counters = std::array<std::pair<const char*, double>, 3>;
    Counters counters() const {
        return {{{"frames_in_place", static_cast<double>(frames_in_place_)},
                 {"copied_frames", static_cast<double>(copied_frames_)},
                 {"missed_frames", static_cast<double>(missed_frames_)}}};
    }

    const std::string& camera() const { return camera_; }
    /// Name of the ring, "" while there is none.
    std::string ring() const { return ring_ ? ring_->name() : ""; }
    /// Size of the largest frame it holds, 0 while there is none.
    std::size_t slot_bytes() const { return ring_ ? ring_->slot_bytes() : 0; }

  private:
    void abandon(int number) noexcept override;
    bool make_room(std::size_t bytes);
    void say_no_room(std::size_t bytes, const std::string& why);
    void announce(const FrameInfo& info, int row_stride, std::size_t bytes, FrameSlot slot);
    void announce_missing(const FrameInfo& info);

    Bus& bus_;
    std::string channel_;
    std::string camera_;
    int slots_;
    std::unique_ptr<FrameRing> ring_;
    // The smallest frame there was no room for since there was room last: that was said. 0: none.
    std::size_t no_room_for_ = 0;
    std::int64_t frames_in_place_ = 0;
    std::int64_t copied_frames_ = 0;
    std::int64_t missed_frames_ = 0;
};

/// Bytes of an encoded message that go out as one datagram (UDP takes 65507, LCM's header and the channel
/// name included).
inline constexpr std::size_t datagram_bytes = 65000;

/// A frame as a self-contained message: raw, rows packed.
image_t self_contained_yuyv(const FrameInfo& info, const std::string& camera, const YuyvView& pixels);

/// A frame as a self-contained message in JPEG: of `quality`, or of a lower one, near the best, at which the
/// encoded message has at most `most_bytes`; of quality 1 where none does (pure noise).
image_t self_contained_jpeg(const FrameInfo& info, const std::string& camera, const YuyvView& pixels,
                            int quality, std::size_t most_bytes);

}  // namespace goalmouth
