#pragma once

#include "core/imaging/frame_memory.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace goalmouth {

enum class PixelFormat { yuyv, jpeg };

/// One image as its source delivered it. The bytes stand in `slot`, where the source was given a FrameMemory
/// and could write there; otherwise they belong to the source and last until its next call.
struct Captured {
    PixelFormat format = PixelFormat::yuyv;
    int width = 0;   // px
    int height = 0;  // px
    int stride = 0;  // bytes from row to row; 0 for JPEG
    std::span<const std::uint8_t> bytes;
    FrameSlot slot;          // empty unless the bytes stand in it
    std::int64_t utime = 0;  // [µs] since 1970-01-01 UTC; 0 where the source knows no time (files)
    std::int64_t lost = 0;   // images the source knows it lost between the one before and this one
};

/// What a source could not deliver, since it was made.
struct SourceCounters {
    std::int64_t unreadable = 0;  // files or video frames that are no image, skipped
    std::int64_t damaged = 0;     // frames the driver marked as damaged or that are too short, skipped
    std::int64_t lost = 0;        // gaps in the device's numbering
    std::int64_t reopened = 0;    // times a device came back after it was gone
};

/// Takes sentences for people: each cause once.
using SourceLog = std::function<void(const std::string&)>;

/// Where images come from. One thread.
class ImageSource {
  public:
    enum class Outcome {
        captured,  // `frame` holds an image
        nothing,   // none within the timeout, or a signal came: ask again
        ended,     // there will be none any more
    };

    ImageSource() = default;
    ImageSource(const ImageSource&) = delete;
    ImageSource& operator=(const ImageSource&) = delete;
    virtual ~ImageSource() = default;

    /// The next image. What `frame` held is given up first. Sources of files deliver at once, in order;
    /// devices wait up to `timeout`.
    virtual Outcome next(Captured& frame, std::chrono::milliseconds timeout) = 0;

    /// Images per second the source itself runs at; 0 where it has no rate of its own.
    virtual double frames_per_second() const { return 0.0; }

    /// Whether images come when they come (a device), rather than when they are asked for.
    virtual bool live() const { return false; }

    const SourceCounters& counters() const { return counters_; }

  protected:
    SourceCounters counters_;
};

}  // namespace goalmouth
