#include "core/messaging/log_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

namespace goalmouth {
namespace {

// Every event: sync word, number, utime, channel size, data size (big-endian), channel, data.
constexpr std::array<std::uint8_t, 4> sync_word = {0xED, 0xA1, 0xDA, 0x01};
constexpr std::size_t header_size = 28;
constexpr std::size_t longest_channel = 1000;  // as LCM's reader has it; LCM itself sends 63 at most
constexpr std::size_t window_size = 256 * 1024;

std::uint64_t big_endian(std::span<const std::uint8_t> bytes) {
    std::uint64_t value = 0;
    for (const std::uint8_t byte : bytes) value = (value << 8) | byte;
    return value;
}

void append_big_endian(std::vector<std::uint8_t>& to, std::uint64_t value, int bytes) {
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
        to.push_back(static_cast<std::uint8_t>(value >> shift));
}

std::string cause() {
    return std::strerror(errno);
}

}  // namespace

LogReader::LogReader(const std::filesystem::path& path) {
    // A pipe that nobody writes to must not hold it up; it is refused below.
    fd_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd_ < 0) throw std::runtime_error("cannot read log " + path.string() + ": " + cause());
    struct stat status {};
    if (fstat(fd_, &status) != 0 || !S_ISREG(status.st_mode)) {
        close(fd_);
        throw std::runtime_error("cannot read log " + path.string() + ": not a regular file");
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
}

LogReader::~LogReader() {
    close(fd_);
}

bool LogReader::read(std::uint64_t position, std::span<std::uint8_t> bytes) {
    if (position > size_ || bytes.size() > size_ - position) return false;
    const auto pull = [this](std::uint64_t from, std::uint8_t* to, std::size_t count) {
        std::size_t done = 0;
        while (done < count) {
            const ssize_t got = pread(fd_, to + done, count - done, static_cast<off_t>(from + done));
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) break;
            done += static_cast<std::size_t>(got);
        }
        return done;
    };
    if (bytes.size() > window_size / 4) return pull(position, bytes.data(), bytes.size()) == bytes.size();
    if (position < window_position_ || position + bytes.size() > window_position_ + window_.size()) {
        window_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(window_size, size_ - position)));
        window_position_ = position;
        window_.resize(pull(position, window_.data(), window_.size()));
        if (bytes.size() > window_.size()) return false;
    }
    std::copy_n(window_.begin() + static_cast<std::ptrdiff_t>(position - window_position_), bytes.size(),
                bytes.begin());
    return true;
}

bool LogReader::starts_at(std::uint64_t position) {
    std::array<std::uint8_t, sync_word.size()> found{};
    return read(position, found) && found == sync_word;
}

/// First sync word that begins in from … end − 1; `end` where there is none.
std::uint64_t LogReader::find_start(std::uint64_t from, std::uint64_t end) {
    std::vector<std::uint8_t> piece;
    while (from < end) {
        piece.resize(static_cast<std::size_t>(std::min<std::uint64_t>(window_size / 4, size_ - from)));
        if (!read(from, piece)) return end;
        const auto found = std::search(piece.begin(), piece.end(), sync_word.begin(), sync_word.end());
        if (found != piece.end())
            return std::min(end, from + static_cast<std::uint64_t>(found - piece.begin()));
        if (from + piece.size() >= size_) return end;
        from += piece.size() - (sync_word.size() - 1);
    }
    return end;
}

/// The header of an event that starts at `position` and lies wholly in the file.
std::optional<LogReader::Header> LogReader::header_at(std::uint64_t position) {
    std::array<std::uint8_t, header_size> raw{};
    if (!read(position, raw) || !std::equal(sync_word.begin(), sync_word.end(), raw.begin())) return {};
    const std::span<const std::uint8_t> bytes(raw);
    Header header;
    header.number = static_cast<std::int64_t>(big_endian(bytes.subspan(4, 8)));
    header.utime = static_cast<std::int64_t>(big_endian(bytes.subspan(12, 8)));
    header.channel_size = big_endian(bytes.subspan(20, 4));
    header.data_size = big_endian(bytes.subspan(24, 4));
    if (header.channel_size < 1 || header.channel_size > longest_channel || header.data_size > 0x7fffffff)
        return {};
    if (position + header_size + header.channel_size + header.data_size > size_) return {};
    return header;
}

/// A header may lie about its sizes. Where no other event follows at once, one that starts inside says it
/// does.
bool LogReader::is_event(std::uint64_t position, const Header& header) {
    const std::uint64_t end = position + header_size + header.channel_size + header.data_size;
    if (end == size_ || starts_at(end)) return true;
    for (std::uint64_t inside = position + 1; (inside = find_start(inside, end)) < end; ++inside) {
        if (header_at(inside)) return false;
    }
    return true;
}

std::optional<LogEvent> LogReader::next() {
    while (position_ < size_) {
        const auto header = header_at(position_);
        if (!header || !is_event(position_, *header)) {
            if (!in_damage_) ++damaged_stretches_;
            in_damage_ = true;
            position_ = find_start(position_ + 1, size_);
            continue;
        }
        in_damage_ = false;
        LogEvent event;
        event.number = header->number;
        event.utime = header->utime;
        std::vector<std::uint8_t> name(static_cast<std::size_t>(header->channel_size));
        event.data.resize(static_cast<std::size_t>(header->data_size));
        if (!read(position_ + header_size, name) ||
            !read(position_ + header_size + header->channel_size, event.data)) {
            position_ = size_;  // the file became shorter, or the disk fails
            ++damaged_stretches_;
            return {};
        }
        event.channel.assign(name.begin(), name.end());
        position_ += header_size + header->channel_size + header->data_size;
        return event;
    }
    return {};
}

std::vector<LogEvent> read_log(const std::filesystem::path& path) {
    LogReader reader(path);
    std::vector<LogEvent> events;
    while (auto event = reader.next()) events.push_back(std::move(*event));
    return events;
}

LogWriter::LogWriter(const std::filesystem::path& path, Existing existing) : path_(path) {
    // Asking first whether there is a file would leave room for one that appears in between.
    const int way = existing == Existing::keep ? O_EXCL : O_TRUNC;
    for (int number = 2;; ++number) {
        fd_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | way, 0666);
        if (fd_ >= 0) return;
        if (way != O_EXCL || errno != EEXIST)
            throw std::runtime_error("cannot write log " + path_.string() + ": " + cause());
        path_ = path.string() + "." + std::to_string(number);
    }
}

LogWriter::~LogWriter() {
    close(fd_);
}

void LogWriter::write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> data) {
    if (channel.empty() || channel.size() > longest_channel || data.size() > 0x7fffffff) {
        throw std::invalid_argument("a message on channel \"" + channel + "\" does not fit a log");
    }
    header_.assign(sync_word.begin(), sync_word.end());
    append_big_endian(header_, static_cast<std::uint64_t>(count_), 8);
    append_big_endian(header_, static_cast<std::uint64_t>(utime), 8);
    append_big_endian(header_, channel.size(), 4);
    append_big_endian(header_, data.size(), 4);
    header_.insert(header_.end(), channel.begin(), channel.end());

    const std::size_t total = header_.size() + data.size();
    std::size_t done = 0;
    while (done < total) {
        iovec pieces[2] = {};
        int count = 0;
        if (done < header_.size()) pieces[count++] = {header_.data() + done, header_.size() - done};
        const std::size_t data_done = done > header_.size() ? done - header_.size() : 0;
        if (data_done < data.size()) {
            pieces[count++] = {const_cast<std::uint8_t*>(data.data()) + data_done, data.size() - data_done};
        }
        const ssize_t written = writev(fd_, pieces, count);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) {
            const std::string why = cause();
            // A reader finds whole events only, so a failure here costs nothing more than a damaged end.
            [[maybe_unused]] const int taken_back = ftruncate(fd_, size_);
            lseek(fd_, size_, SEEK_SET);
            throw std::runtime_error("cannot write log " + path_.string() + ": " + why);
        }
        done += static_cast<std::size_t>(written);
    }
    ++count_;
    size_ += static_cast<std::int64_t>(total);
}

}  // namespace goalmouth
