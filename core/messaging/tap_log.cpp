#include "core/messaging/tap_log.h"

#include "core/messaging/image_output.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>
#include <vector>

#include <spdlog/spdlog.h>

namespace goalmouth {
namespace {

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    return bytes;
}

}  // namespace

TapLog::TapLog(const std::filesystem::path& wanted, int slice_bytes, std::string image_channel,
               std::string slices_channel, std::int64_t begin_utime, Time begin)
    : writer_(wanted, LogWriter::Existing::keep),
      pacer_(slice_bytes),
      image_channel_(std::move(image_channel)),
      slices_channel_(std::move(slices_channel)),
      begin_utime_(begin_utime),
      begin_(begin),
      written_until_(begin) {}

void TapLog::append(const std::string& channel, std::span<const std::uint8_t> message, Time time) {
    const std::int64_t utime =
        begin_utime_ + std::chrono::duration_cast<std::chrono::microseconds>(time - begin_).count();
    try {
        writer_.write(channel, utime, message);
    } catch (const std::runtime_error& error) {
        if (not_written_++ == 0)
            spdlog::error(fmt::format(
                "{}: what comes now is missing in it until there is room; what it holds stays readable",
                error.what()));
    }
}

void TapLog::write(const std::string& channel, std::span<const std::uint8_t> message, Time now) {
    catch_up(now);
    append(channel, message, now);
}

void TapLog::write(const image_t& self_contained, Time now) {
    catch_up(now);
    if (static_cast<std::size_t>(self_contained.getEncodedSize()) <= datagram_bytes) {
        append(image_channel_, encoded(self_contained), now);
    } else {
        pacer_.offer(self_contained, now);
    }
}

void TapLog::catch_up(Time now) {
    for (;;) {
        const auto wait = pacer_.next_due(written_until_);
        if (!wait || *wait > now - written_until_) break;
        written_until_ += *wait;
        const auto slice = pacer_.due(written_until_);
        if (slice) append(slices_channel_, encoded(*slice), written_until_);
    }
    written_until_ = std::max(written_until_, now);
}

void TapLog::finish() {
    while (const auto wait = pacer_.next_due(written_until_)) catch_up(written_until_ + *wait);
}

}  // namespace goalmouth
