#pragma once

#include "tests/bench/graph_bench.h"

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace goalmouth::bench {

/// What happens to a frame, in this order; each is a message that carries the frame's utime and seq.
enum class Stage { image, segments, candidates, posts, pose };
inline constexpr std::size_t stage_count = 5;
/// Channels by stage.
extern const std::array<const char*, stage_count> stage_channels;

/// One message about a frame. Times in µs since 1970 UTC.
struct StageEntry {
    std::int64_t seq = 0;
    std::int64_t utime = 0;  // capture
    std::int64_t sent = 0;
    std::int64_t heard = 0;
};

/// Who heard what of which frame, and when. May be written by one thread and read by another.
class FrameJournal {
  public:
    void note(Stage stage, const StageEntry& entry);
    /// The same from an encoded message, of which nothing but utime and seq is decoded: those who are
    /// measured need the processor. Nothing happens where it is about no frame.
    void note_message(Stage stage, std::span<const std::uint8_t> message, std::int64_t sent,
                      std::int64_t heard);

    /// The entry with the highest seq.
    std::optional<StageEntry> latest(Stage stage) const;
    /// Messages sent up to then.
    std::int64_t sent_until(Stage stage, std::int64_t utime) const;

    struct Summary {
        std::int64_t frames = 0;    // that should have gone through
        std::int64_t lost = 0;      // of these, without posts or without a pose
        std::int64_t not_sent = 0;  // of these, never captured: the camera stood still or was slow
        std::vector<StageResult> stages;
    };
    /// About the frames captured from `begin` on and before `end`: those of which anything was heard, those
    /// that the numbering says were between, and those that a camera of so many frames per second owes
    /// beyond them (one more or less is where the edges fall). A message that came twice counts once, as it
    /// came first.
    Summary summary(std::int64_t begin, std::int64_t end, double frames_per_second) const;

  private:
    mutable std::mutex mutex_;
    std::array<std::vector<StageEntry>, stage_count> entries_;
    std::array<std::optional<StageEntry>, stage_count> latest_;
};

}  // namespace goalmouth::bench
