#pragma once

#include "core/imaging/jpeg.h"
#include "core/imaging/yuyv.h"
#include "core/messaging/bus.h"
#include "core/messaging/frame_ring.h"
#include "core/messaging/slices.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <goalmouth/image_slice_t.hpp>
#include <goalmouth/image_t.hpp>

namespace goalmouth {

/// A camera frame as a module sees it, wherever its pixels stand. Lasts for the call it is handed to; who
/// needs it longer keeps it in KeptFrames (core/messaging/kept_frames.h).
struct Frame {
    std::int64_t utime = 0;  // µs, capture time
    std::int64_t seq = 0;
    std::string camera;
    intrinsics_t intrinsics{};
    std::int32_t exposure_us = 0;  // 0 = unknown
    std::int32_t readout_us = 0;   // 0 = global shutter or unknown
    YuyvView pixels;
    std::int64_t dropped_before =
        0;  // frames of this camera missing between the last one and this: tell Status::dropped

    /// Ask after the last look at `pixels` and before publishing what came of it: false where the camera has
    /// overwritten them.
    bool still_valid() const { return !ring_frame || ring_frame->still_valid(); }

    bool live = false;                         // came by shared memory
    std::optional<RingFrame> ring_frame;       // where the pixels stand in a ring: live and not compressed
    std::shared_ptr<const YuyvImage> decoded;  // where they were a JPEG
};

/// The receiving end of a camera, for every module that looks at pixels: frames from shared memory as they
/// come live, and from self-contained messages as logs hold them. Each frame is handed out once.
///
/// Live, the newest descriptor counts, and the self-contained form of the same frames is left alone. On
/// replay descriptors refer to rings that are gone; then the self-contained form is used, each frame of it.
/// Numbers that start again lower (a camera started anew, a log played again) are taken.
///
/// Raw frames from shared memory are neither copied nor do they cost memory that grows with their size. A
/// JPEG is copied out, compressed, and decoded once it is known to be whole: decoding looks at some bytes
/// twice, and would trust the second look as the first, whatever their producer wrote in between.
class ImageInput {
  public:
    using Handler = std::function<void(const Frame&)>;
    /// Of a descriptor whose frame the camera has overwritten before it could be handed out.
    using MissedHandler = std::function<void(const image_t& descriptor)>;

    /// Channels: image_t descriptors, self-contained image_t, image_slice_t; "" for those not to listen to.
    /// `which` is for descriptors: all of them is for who must not miss a frame and can be a few behind, as a
    /// tap.
    ImageInput(Bus& bus, const std::string& descriptors, const std::string& tap, const std::string& slices,
               Handler handler, Delivery which = Delivery::newest);
    void on_overwritten(MissedHandler handler) { missed_ = std::move(handler); }
    ImageInput(const ImageInput&) = delete;
    ImageInput& operator=(const ImageInput&) = delete;

    std::int64_t frames() const { return frames_; }            // handed out
    std::int64_t dropped() const { return dropped_; }          // missing by their numbers
    std::int64_t frame_gone() const { return frame_gone_; }    // descriptors of rings that are no more
    std::int64_t overwritten() const { return overwritten_; }  // descriptors read too late
    std::int64_t incomplete() const { return assembler_.incomplete(); }  // images of which slices were lost

  private:
    struct Mark {
        std::int64_t utime = 0;
        std::int64_t seq = 0;
        bool operator==(const Mark&) const = default;
    };
    struct Camera {
        Mark last;                 // handed out last
        std::optional<Mark> live;  // handed out last from a ring
    };

    void take(const std::string& channel, const image_t& image);
    void take(const std::string& channel, const image_slice_t& slice);
    bool is_news(const std::string& camera, Mark mark, bool self_contained) const;
    bool decode_jpeg(const std::string& channel, const image_t& image,
                     const std::optional<RingFrame>& ring_frame);
    void miss(const image_t& descriptor);
    void hand_out(const std::string& channel, const image_t& image, std::optional<RingFrame> ring_frame);

    Bus& bus_;
    Handler handler_;
    MissedHandler missed_;
    RingReader rings_;
    SliceAssembler assembler_;
    JpegDecoder decoder_;
    std::vector<std::uint8_t> compressed_;  // of a JPEG in a ring
    std::shared_ptr<YuyvImage> decoded_;    // of the frame handed out last that was a JPEG
    std::map<std::string, Camera> cameras_;
    std::int64_t frames_ = 0;
    std::int64_t dropped_ = 0;
    std::int64_t frame_gone_ = 0;
    std::int64_t overwritten_ = 0;
};

}  // namespace goalmouth
