#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace goalmouth {

/// One message of an LCM log.
struct LogEvent {
    std::int64_t number = 0;
    std::int64_t utime = 0;  // µs since 1970-01-01 UTC, as the log says: real logs run backwards at times
    std::string channel;
    std::vector<std::uint8_t> data;
};

/// Reads an LCM log file event by event, whatever state it is in. LCM's own reader delivers a cut last record
/// filled up with zeros, and stops at damage; this one delivers whole events only and looks for the next one
/// after anything else.
class LogReader {
  public:
    /// Throws std::runtime_error with the path where the file cannot be read.
    explicit LogReader(const std::filesystem::path& path);
    ~LogReader();
    LogReader(const LogReader&) = delete;
    LogReader& operator=(const LogReader&) = delete;

    /// Nothing once the log has ended.
    std::optional<LogEvent> next();

    /// Stretches of the file that held no whole event: a cut end, damage, foreign bytes.
    std::int64_t damaged_stretches() const { return damaged_stretches_; }

  private:
    struct Header {
        std::int64_t number = 0;
        std::int64_t utime = 0;
        std::uint64_t channel_size = 0;
        std::uint64_t data_size = 0;
    };
    std::optional<Header> header_at(std::uint64_t position);
    bool is_event(std::uint64_t position, const Header& header);
    bool starts_at(std::uint64_t position);
    std::uint64_t find_start(std::uint64_t from, std::uint64_t end);
    bool read(std::uint64_t position, std::span<std::uint8_t> bytes);

    int fd_ = -1;
    std::uint64_t size_ = 0;
    std::uint64_t position_ = 0;
    bool in_damage_ = false;
    std::int64_t damaged_stretches_ = 0;
    std::uint64_t window_position_ = 0;
    std::vector<std::uint8_t> window_;
};

/// All events of a log. Throws std::runtime_error where the file cannot be read.
std::vector<LogEvent> read_log(const std::filesystem::path& path);

/// Writes an LCM log file that lcm-logplayer and every LCM language read.
class LogWriter {
  public:
    enum class Existing {
        replace,
        keep,  // where there is a file of this name, "NAME.2" and so on is made
    };
    /// Throws std::runtime_error with path and cause.
    explicit LogWriter(const std::filesystem::path& path, Existing existing = Existing::replace);
    ~LogWriter();
    LogWriter(const LogWriter&) = delete;
    LogWriter& operator=(const LogWriter&) = delete;

    /// The event is with the operating system when this returns. Throws std::runtime_error where the disk is
    /// full or broken, having taken back the part that was written.
    void write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> data);

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    int fd_ = -1;
    std::int64_t count_ = 0;
    std::int64_t size_ = 0;
    std::vector<std::uint8_t> header_;
};

}  // namespace goalmouth
