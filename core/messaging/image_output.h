#pragma once

#include "core/imaging/yuyv.h"
#include "core/messaging/bus.h"
#include "core/messaging/frame_ring.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>

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
class ImageOutput {
  public:
    /// The ring is made with the first frame, and anew where a frame is larger than its slots.
    ImageOutput(Bus& bus, std::string channel, std::string camera, int slots = 8);

    /// Copies a frame into the ring and announces it. Throws std::runtime_error where shared memory does not
    /// suffice.
    void publish(const FrameInfo& info, const YuyvView& pixels);

    /// Without the copy: memory for the next frame, at least `bytes` long; fill it, then announce it by one
    /// of the functions below.
    std::span<std::uint8_t> begin(std::size_t bytes);
    void publish_yuyv(const FrameInfo& info, int row_stride);
    void publish_jpeg(const FrameInfo& info, std::size_t jpeg_bytes);

    const std::string& camera() const { return camera_; }
    /// Name of the ring, "" before the first frame.
    std::string ring() const { return ring_ ? ring_->name() : ""; }

  private:
    void announce(const FrameInfo& info, const char* encoding, int row_stride, std::size_t bytes);

    Bus& bus_;
    std::string channel_;
    std::string camera_;
    int slots_;
    std::unique_ptr<FrameRing> ring_;
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
