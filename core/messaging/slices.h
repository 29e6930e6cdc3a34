#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <goalmouth/image_slice_t.hpp>
#include <goalmouth/image_t.hpp>

namespace goalmouth {

/// Cuts self-contained images into slices and says when each is due: evenly over most of the frame interval,
/// because whoever listens through a stock 208 KiB socket buffer holds a dozen milliseconds of raw video at
/// most (DESIGN, section 3). How long that is shows with the second image; the first is sent at leisure.
/// Where listeners are behind it waits for them, for 50 ms at most: then they are taken to be stuck, and left
/// to themselves for a second. Time is the caller's. One image is sent, up to eight wait; a further one
/// replaces the last that waits.
class SlicePacer {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Data bytes of a slice. Throws std::invalid_argument outside 1000…65000.
    explicit SlicePacer(int slice_bytes);

    void offer(const image_t& self_contained, Time now);

    /// The next slice if its time has come. `congestion`: how full the fullest listener's buffer is, 0…1
    /// (Bus::congestion).
    std::optional<image_slice_t> due(Time now, double congestion = 0.0);
    /// How long until the next slice is due, 0 if it is; nothing where none waits.
    std::optional<std::chrono::microseconds> next_due(Time now) const;

    /// Images that were replaced before a slice of them was sent.
    std::int64_t left_out() const { return left_out_; }

  private:
    struct Encoded {
        std::int64_t utime = 0;
        std::int64_t seq = 0;
        std::string camera;
        std::vector<std::uint8_t> bytes;
        std::chrono::microseconds interval{0};  // to send it in
        bool interval_known = false;
        Time start;
    };
    Time end_of(const Encoded& image) const;
    void hurry_up_to(std::chrono::microseconds interval);
    std::int32_t slices(const Encoded& image) const;
    std::chrono::microseconds gap(const Encoded& image) const;
    Time time_of_next() const;
    bool waits_for_listeners(Time now, double congestion);

    std::size_t slice_bytes_;
    std::deque<Encoded> images_;   // being sent, waiting
    std::int32_t next_slice_ = 0;  // of the first image
    Time last_sent_ = Time::min();
    Time held_until_ = Time::min();
    Time patience_until_ = Time::min();   // while holding
    Time impatient_until_ = Time::min();  // after holding in vain
    bool holding_ = false;
    std::optional<std::int64_t> last_utime_;
    std::int64_t left_out_ = 0;
};

/// Puts slices together again. A slice lost on the way costs its image. Memory: at most two images of a
/// camera and four cameras in assembly, and never more than the bytes that came.
class SliceAssembler {
  public:
    /// The encoded image_t once its last slice is in. `slice` has passed validation.h.
    std::optional<std::vector<std::uint8_t>> add(const image_slice_t& slice);

    /// Images given up because slices were lost or contradicted each other.
    std::int64_t incomplete() const { return incomplete_; }
    /// What was wrong with the last slice: empty, or words for Bus::reject.
    const std::string& contradiction() const { return contradiction_; }

  private:
    struct Assembly {
        std::string camera;
        std::int64_t utime = 0;
        std::int64_t seq = 0;
        std::int32_t slices = 0;
        std::int32_t total_size = 0;
        std::int32_t next_slice = 0;
        std::vector<std::uint8_t> bytes;
    };
    void begin(const image_slice_t& slice);
    void give_up(std::deque<Assembly>::iterator assembly);

    std::deque<Assembly> assemblies_;  // the oldest first
    std::int64_t incomplete_ = 0;
    std::string contradiction_;
};

}  // namespace goalmouth
