#include "core/imaging/v4l2_source.h"

#include "core/imaging/file_error.h"
#include "core/imaging/yuyv.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <poll.h>
#include <stdexcept>
#include <time.h>
#include <utility>
#include <vector>

namespace goalmouth {

namespace {

constexpr std::chrono::milliseconds first_back_off{250};
constexpr std::chrono::milliseconds longest_back_off{4000};
constexpr std::chrono::milliseconds between_looks{1000};

std::int64_t microseconds(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<std::int64_t>(t.tv_sec) * 1000000 + t.tv_nsec / 1000;
}

/// UTC minus monotonic time, read between two readings of the latter; the tightest of a few, should the
/// scheduler step in.
std::int64_t utc_offset() {
    std::int64_t best_gap = INT64_MAX;
    std::int64_t offset = 0;
    for (int i = 0; i < 3 && best_gap > 20; ++i) {
        const std::int64_t before = microseconds(CLOCK_MONOTONIC);
        const std::int64_t utc = microseconds(CLOCK_REALTIME);
        const std::int64_t after = microseconds(CLOCK_MONOTONIC);
        if (after - before < best_gap) {
            best_gap = after - before;
            offset = utc - (before + after) / 2;
        }
    }
    return offset;
}

/// Capture time [µs] of the monotonic clock.
std::int64_t capture_stamp(const v4l2_buffer& buffer) {
    if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC)
        return microseconds(CLOCK_MONOTONIC);
    return static_cast<std::int64_t>(buffer.timestamp.tv_sec) * 1000000 + buffer.timestamp.tv_usec;
}

std::string rate_text(double frames_per_second) {
    char text[48];
    std::snprintf(text, sizeof text, "%.4g frames/s", frames_per_second);
    return text;
}

std::string wanted(const V4l2Settings& s) {
    return std::string(s.format == PixelFormat::yuyv ? "YUYV " : "MJPG ") + std::to_string(s.width) + "x" +
           std::to_string(s.height);
}

}  // namespace

V4l2Source::V4l2Source(const V4l2Settings& settings, SourceLog log, FrameMemory* memory)
    : settings_(settings),
      log_(std::move(log)),
      memory_(settings.format == PixelFormat::yuyv ? memory : nullptr),
      buffers_(device_, memory_) {
    start();
}

/// Opens the device and asks for format and rate.
void V4l2Source::set_up() {
    device_.open(settings_.device);
    const bool compressed = settings_.format == PixelFormat::jpeg;
    v4l2_pix_format format{};
    const auto names = compressed ? std::vector<std::uint32_t>{V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_JPEG}
                                  : std::vector<std::uint32_t>{V4L2_PIX_FMT_YUYV};
    for (const std::uint32_t fourcc : names) {
        format = device_.set_format(fourcc, settings_.width, settings_.height);
        if (format.pixelformat == fourcc) break;
        format.pixelformat = 0;
    }
    if (format.pixelformat == 0 || format.width != static_cast<std::uint32_t>(settings_.width) ||
        format.height != static_cast<std::uint32_t>(settings_.height)) {
        throw FileError(settings_.device + ": \"" + device_.card() + "\" does not offer " +
                        wanted(settings_) + "; it offers: " + device_.offers());
    }
    if (format.field != V4L2_FIELD_NONE && format.field != V4L2_FIELD_ANY)
        throw FileError(settings_.device + ": \"" + device_.card() + "\" delivers interlaced frames only");
    stride_ =
        compressed ? 0 : std::max(static_cast<int>(format.bytesperline), yuyv_row_bytes(settings_.width));
    image_bytes_ = std::max<std::size_t>(
        format.sizeimage, static_cast<std::size_t>(stride_) * static_cast<std::size_t>(settings_.height));
    rate_ = device_.set_rate(settings_.frames_per_second);
    if (settings_.frames_per_second > 0.0 && std::abs(rate_ - settings_.frames_per_second) > 0.5 && log_) {
        log_(settings_.device + ": asked for " + rate_text(settings_.frames_per_second) + ", the camera " +
             (rate_ > 0.0 ? "runs at " + rate_text(rate_) : "keeps a rate of its own"));
    }
}

void V4l2Source::start() {
    buffers_.stop();
    try {
        set_up();
        if (!buffers_.start(settings_.buffers, image_bytes_)) {
            set_up();
            buffers_.start(settings_.buffers, image_bytes_);
        }
        if (const std::string& refusal = buffers_.refusal(); !refusal.empty() && refusal != last_refusal_) {
            if (log_)
                log_(settings_.device + ": \"" + device_.card() + "\" does not write into shared memory (" +
                     refusal + "); each image is copied once");
            last_refusal_ = refusal;
        }
    } catch (...) {
        buffers_.stop();
        throw;
    }
    next_look_ = Clock::now() + between_looks;
    last_sequence_.reset();
}

void V4l2Source::gone(const std::string& why) {
    buffers_.stop();
    last_stamp_.reset();
    back_off_ = first_back_off;
    next_try_ = Clock::now() + back_off_;
    last_failure_.clear();
    if (log_) log_(settings_.device + ": the camera is gone (" + why + "); waiting for it");
}

bool V4l2Source::try_again(std::chrono::milliseconds timeout) {
    const auto now = Clock::now();
    if (now < next_try_) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(next_try_ - now) +
                          std::chrono::milliseconds(1);
        poll(nullptr, 0, static_cast<int>(std::min(left, timeout).count()));
        if (Clock::now() < next_try_) return false;
    }
    try {
        start();
    } catch (const std::runtime_error& error) {
        if (log_ && last_failure_ != error.what()) log_(std::string(error.what()) + "; trying on");
        last_failure_ = error.what();
        back_off_ = std::min(2 * back_off_, longest_back_off);
        next_try_ = Clock::now() + back_off_;
        return false;
    }
    ++counters_.reopened;
    if (log_) log_(settings_.device + ": the camera is back");
    return true;
}

/// Starts anew, in place, once the memory that lacked room has it.
void V4l2Source::look_for_room() {
    if (!device_.is_open() || !buffers_.lacks_room() || Clock::now() < next_look_) return;
    next_look_ = Clock::now() + between_looks;
    if (!memory_->open(image_bytes_)) return;
    try {
        start();
    } catch (const std::runtime_error& error) {
        gone(error.what());
    }
}

std::int64_t V4l2Source::lost_before(std::uint32_t sequence, std::int64_t stamp) {
    std::int64_t lost = 0;
    if (last_sequence_) {
        const std::uint32_t gap = sequence - *last_sequence_ - 1;  // modulo 2³²: the number wraps
        if (gap < 0x80000000U) lost = gap;                         // else the driver began anew
    } else if (last_stamp_) {
        const double periods = 1e-6 * static_cast<double>(stamp - *last_stamp_) * rate_;
        lost = std::max(std::int64_t{0}, static_cast<std::int64_t>(std::llround(periods)) - 1);
    }
    last_sequence_ = sequence;
    last_stamp_ = stamp;
    return lost;
}

bool V4l2Source::take(Captured& frame) {
    V4l2Buffers::Filled filled;
    if (!buffers_.take(filled)) {
        if (errno == EAGAIN) return false;
        if (errno == EIO) {  // the driver lost a frame and goes on
            ++counters_.damaged;
            return false;
        }
        gone(errno == EBADSLT ? "the driver names a buffer it does not have" : std::strerror(errno));
        return false;
    }
    const v4l2_buffer& buffer = filled.buffer;
    const std::int64_t lost = lost_before(buffer.sequence, capture_stamp(buffer));
    counters_.lost += lost;
    lost_since_frame_ += lost;
    const std::size_t needed =
        settings_.format == PixelFormat::jpeg
            ? 4
            : static_cast<std::size_t>(stride_) * static_cast<std::size_t>(settings_.height - 1) +
                  static_cast<std::size_t>(yuyv_row_bytes(settings_.width));
    if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0 || filled.bytes.size() < needed) {
        ++counters_.damaged;
        ++lost_since_frame_;
        return false;
    }
    frame.format = settings_.format;
    frame.width = settings_.width;
    frame.height = settings_.height;
    frame.stride = stride_;
    frame.bytes = filled.bytes;
    frame.slot = std::move(filled.slot);
    frame.utime = capture_stamp(buffer) + utc_offset();
    frame.lost = std::exchange(lost_since_frame_, 0);
    return true;
}

ImageSource::Outcome V4l2Source::next(Captured& frame, std::chrono::milliseconds timeout) {
    const auto deadline = Clock::now() + timeout;
    frame = {};
    look_for_room();
    for (;;) {
        if (device_.is_open() && !buffers_.refill()) gone(std::strerror(errno));
        const auto left = std::max(std::chrono::milliseconds(0),
                                   std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()));
        if (!device_.is_open() && !try_again(left)) return Outcome::nothing;
        pollfd waiting{device_.fd(), POLLIN, 0};
        const int ready = poll(&waiting, 1, static_cast<int>(left.count()));
        if (ready <= 0) return Outcome::nothing;  // time is up, or a signal came
        const bool was_open = device_.is_open();
        if (take(frame)) return Outcome::captured;
        if (was_open && !device_.is_open()) return Outcome::nothing;
        // An error without a frame to take would come back at once, for ever.
        if ((waiting.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0 && (waiting.revents & POLLIN) == 0) {
            gone("it reports an error and no frame");
            return Outcome::nothing;
        }
        if (Clock::now() >= deadline) return Outcome::nothing;
    }
}

}  // namespace goalmouth
