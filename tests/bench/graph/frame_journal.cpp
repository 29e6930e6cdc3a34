#include "tests/bench/graph/frame_journal.h"

#include "core/messaging/channels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace goalmouth::bench {
namespace {

constexpr std::size_t hash_bytes = 8;

std::int64_t big_endian(std::span<const std::uint8_t> bytes) {
    std::uint64_t value = 0;
    for (const std::uint8_t byte : bytes) value = (value << 8) | byte;
    return static_cast<std::int64_t>(value);
}

}  // namespace

const std::array<const char*, stage_count> stage_channels{
    channels::image, channels::segments, channels::candidates, channels::posts, channels::pose};

void FrameJournal::note(Stage stage, const StageEntry& entry) {
    const std::lock_guard lock(mutex_);
    const auto i = static_cast<std::size_t>(stage);
    entries_[i].push_back(entry);
    if (!latest_[i] || entry.seq > latest_[i]->seq) latest_[i] = entry;
}

void FrameJournal::note_message(Stage stage, std::span<const std::uint8_t> message, std::int64_t sent,
                                std::int64_t heard) {
    if (message.size() < hash_bytes + 16) return;
    // Every message of a stage begins with utime and seq.
    const std::int64_t utime = big_endian(message.subspan(hash_bytes, 8));
    const std::int64_t seq = big_endian(message.subspan(hash_bytes + 8, 8));
    if (seq >= 0) note(stage, {seq, utime, sent, heard});
}

std::optional<StageEntry> FrameJournal::latest(Stage stage) const {
    const std::lock_guard lock(mutex_);
    return latest_[static_cast<std::size_t>(stage)];
}

std::int64_t FrameJournal::sent_until(Stage stage, std::int64_t utime) const {
    const std::lock_guard lock(mutex_);
    const auto& entries = entries_[static_cast<std::size_t>(stage)];
    return std::count_if(entries.begin(), entries.end(),
                         [&](const StageEntry& entry) { return entry.sent <= utime; });
}

FrameJournal::Summary FrameJournal::summary(std::int64_t begin, std::int64_t end,
                                            double frames_per_second) const {
    const std::lock_guard lock(mutex_);
    std::array<std::map<std::int64_t, const StageEntry*>, stage_count> by_seq;
    std::optional<std::pair<std::int64_t, std::int64_t>> range;  // of seq
    for (std::size_t i = 0; i < stage_count; ++i) {
        for (const StageEntry& entry : entries_[i]) {
            if (entry.utime < begin || entry.utime >= end) continue;
            by_seq[i].try_emplace(entry.seq, &entry);
            if (!range) range.emplace(entry.seq, entry.seq);
            range->first = std::min(range->first, entry.seq);
            range->second = std::max(range->second, entry.seq);
        }
    }
    Summary result;
    if (range) result.frames = range->second - range->first + 1;
    const std::int64_t owed = std::llround(1e-6 * static_cast<double>(end - begin) * frames_per_second);
    if (owed - result.frames > 1) result.not_sent = owed - result.frames;
    result.frames += result.not_sent;
    for (std::size_t i = 0; i < stage_count; ++i) {
        StageResult stage;
        stage.channel = stage_channels[i];
        std::vector<double> sent;
        std::vector<double> heard;
        for (const auto& [seq, entry] : by_seq[i]) {
            sent.push_back(static_cast<double>(entry->sent - entry->utime));
            heard.push_back(static_cast<double>(entry->heard - entry->utime));
        }
        stage.lost = result.frames - static_cast<std::int64_t>(heard.size());
        stage.sent = Latency(std::move(sent));
        stage.heard = Latency(std::move(heard));
        result.stages.push_back(std::move(stage));
    }
    const auto& posts = by_seq[static_cast<std::size_t>(Stage::posts)];
    const auto& poses = by_seq[static_cast<std::size_t>(Stage::pose)];
    const auto whole = std::count_if(posts.begin(), posts.end(),
                                     [&](const auto& entry) { return poses.contains(entry.first); });
    result.lost = result.frames - whole;
    return result;
}

}  // namespace goalmouth::bench
