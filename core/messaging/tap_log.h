#pragma once

#include "core/messaging/log_file.h"
#include "core/messaging/slices.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include <goalmouth/image_t.hpp>

namespace goalmouth {

/// An LCM log of images and messages that needs no network to be made: two megapixels raw at 30 frames/s are
/// 115 MB/s, which no plain lcm-logger receives through a stock buffer. Images larger than a datagram stand
/// in it as slices, spread over the frame interval as SlicePacer sends them, so that a plain lcm-logplayer
/// plays them at a pace receivers can follow.
///
/// Time is the caller's. Stamps count from the wall clock as it was at the beginning, by the steady clock: a
/// wall clock that is set meanwhile, as on a robot that meets its time server late, neither holds pictures up
/// nor lets stamps run backwards.
///
/// Where the disk is full, that is said once, what is not written is counted, and each further event is
/// tried: the file stays readable.
class TapLog {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// `begin_utime` is what the wall clock says at `begin` [µs since 1970]. Never replaces a file: where
    /// there is one of this name, "NAME.2" and so on is made. Throws std::runtime_error with path and cause,
    /// std::invalid_argument as SlicePacer does.
    TapLog(const std::filesystem::path& wanted, int slice_bytes, std::string image_channel,
           std::string slices_channel, std::int64_t begin_utime, Time begin);

    void write(const std::string& channel, std::span<const std::uint8_t> message, Time now);
    void write(const image_t& self_contained, Time now);
    /// Writes the slices whose time has come.
    void catch_up(Time now);
    /// Writes all that is left, with the stamps it is due at.
    void finish();

    const std::filesystem::path& file() const { return writer_.path(); }
    std::int64_t not_written() const { return not_written_; }  // messages, slices among them
    /// Images left out because more came than fit the time.
    std::int64_t left_out() const { return pacer_.left_out(); }

  private:
    void append(const std::string& channel, std::span<const std::uint8_t> message, Time time);

    LogWriter writer_;
    SlicePacer pacer_;
    std::string image_channel_;
    std::string slices_channel_;
    std::int64_t begin_utime_;
    Time begin_;
    Time written_until_;
    std::int64_t not_written_ = 0;
};

}  // namespace goalmouth
