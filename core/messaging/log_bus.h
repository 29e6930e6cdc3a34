#pragma once

#include "core/messaging/bus.h"
#include "core/messaging/log_file.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// An LCM log file as a bus. Subscriptions hear the input log, as fast as it can be read; what is published
/// goes into the output log. Either may be absent: nothing is heard then, or what is published is counted and
/// left.
///
/// Published messages do not come back to subscriptions.
class LogBus : public Bus {
  public:
    struct Files {
        std::filesystem::path input;   // "" = none
        std::filesystem::path output;  // "" = none; replaced if it exists
    };
    /// Throws std::runtime_error where a file cannot be opened.
    explicit LogBus(const Files& files);

    /// Appends an event. Throws std::runtime_error where the disk is full.
    void publish(const std::string& channel, std::span<const std::uint8_t> message) override;
    void subscribe(const std::string& channel, Delivery delivery, Handler handler) override;
    void subscribe_all(ChannelHandler handler) override;
    /// Delivers the next event that somebody subscribed to, skipping others; never waits. False at the end of
    /// the log.
    bool dispatch(std::chrono::milliseconds timeout) override;

    /// The input log has no more events.
    bool finished() const { return finished_; }

    /// Time stamp of the events published from now on: the utime of the data. While an event of the input log
    /// is delivered, it is that event's.
    void set_time(std::int64_t utime) { utime_ = utime; }
    std::int64_t time() const { return utime_; }

    /// As LogReader says.
    std::int64_t damaged_stretches() const { return reader_ ? reader_->damaged_stretches() : 0; }

  private:
    std::optional<LogReader> reader_;
    std::optional<LogWriter> writer_;
    std::map<std::string, std::vector<Handler>> handlers_;
    std::vector<ChannelHandler> handlers_of_all_;
    std::int64_t utime_ = 0;
    bool finished_ = true;
};

}  // namespace goalmouth
