#pragma once

#include "core/imaging/source.h"
#include "core/imaging/v4l2_buffers.h"
#include "core/imaging/v4l2_device.h"

#include <chrono>
#include <optional>
#include <string>

namespace goalmouth {

struct V4l2Settings {
    std::string device = "/dev/video0";
    PixelFormat format = PixelFormat::yuyv;  // jpeg: MJPG, or the JPEG some drivers call it
    int width = 640;                         // px
    int height = 480;                        // px
    double frames_per_second = 30.0;         // 0: as the device is set
    int buffers = 4;                         // the driver may hold
};

/// A camera behind Video4Linux 2: progressive frames, streamed straight into a FrameMemory where the driver
/// can do that, else through buffers of its own.
///
/// Frames the driver marks damaged, or that are too short, are counted and skipped; gaps in its numbering are
/// counted as lost. A camera that goes away (unplugged) is reported and opened again when it is back, asked
/// after 0.25 s, then ever more rarely up to 4 s; what it would have taken meanwhile is not counted. Capture
/// time is the driver's monotonic stamp, moved to UTC. Bytes are passed on as they come: a camera that
/// delivers limited range (Y 16…235) needs a colour table made from its own pictures, as any camera does.
class V4l2Source : public ImageSource {
  public:
    /// Throws FileError where the device does not offer what is asked for, with the list of what it does;
    /// std::runtime_error where it cannot be opened or is in use. `memory` is for uncompressed images. A
    /// driver that does not write there is reported once. While it has no room, images come through the
    /// driver's buffers; it is asked again each second. The change to slots starts the camera anew, and its
    /// numbering: the frames lost by that are counted by the time between frames and the rate, where it has
    /// one.
    V4l2Source(const V4l2Settings& settings, SourceLog log, FrameMemory* memory = nullptr);

    /// Waits at most `timeout`; early after a signal.
    Outcome next(Captured& frame, std::chrono::milliseconds timeout) override;
    double frames_per_second() const override { return rate_; }
    bool live() const override { return true; }

    /// Whether frames are being delivered now (false while unplugged).
    bool connected() const { return device_.is_open(); }
    /// Whether they come in slots of the memory.
    bool in_place() const { return buffers_.in_place(); }

  private:
    using Clock = std::chrono::steady_clock;

    void set_up();
    void start();
    void gone(const std::string& why);
    bool try_again(std::chrono::milliseconds timeout);
    void look_for_room();
    bool take(Captured& frame);
    std::int64_t lost_before(std::uint32_t sequence, std::int64_t stamp);

    V4l2Settings settings_;
    SourceLog log_;
    FrameMemory* memory_;  // none for compressed images
    V4l2Device device_;
    V4l2Buffers buffers_;
    int stride_ = 0;
    std::size_t image_bytes_ = 0;
    double rate_ = 0.0;
    std::optional<std::uint32_t> last_sequence_;  // none right after a start
    std::optional<std::int64_t> last_stamp_;      // [µs]; none before the first frame, and of a camera gone
    std::int64_t lost_since_frame_ = 0;
    Clock::time_point next_try_{};
    std::chrono::milliseconds back_off_{0};
    Clock::time_point next_look_{};
    std::string last_failure_;
    std::string last_refusal_;
};

}  // namespace goalmouth
