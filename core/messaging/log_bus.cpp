#include "core/messaging/log_bus.h"

#include <utility>

namespace goalmouth {

LogBus::LogBus(const Files& files) {
    if (!files.input.empty()) {
        std::error_code ignored;
        if (!files.output.empty() && std::filesystem::equivalent(files.input, files.output, ignored)) {
            throw std::runtime_error("log " + files.input.string() + " cannot be input and output at once");
        }
        reader_.emplace(files.input);
        finished_ = false;
    }
    if (!files.output.empty()) writer_.emplace(files.output);
}

void LogBus::publish(const std::string& channel, std::span<const std::uint8_t> message) {
    if (writer_) writer_->write(channel, utime_, message);
    ++counters_.published;
}

// One event is delivered at a time, so the newest is each.
void LogBus::subscribe(const std::string& channel, Delivery, Handler handler) {
    handlers_[channel].push_back(std::move(handler));
}

void LogBus::subscribe_all(ChannelHandler handler) {
    handlers_of_all_.push_back(std::move(handler));
}

bool LogBus::dispatch(std::chrono::milliseconds) {
    while (!finished_) {
        const auto event = reader_->next();
        if (!event) {
            finished_ = true;
            break;
        }
        const auto found = handlers_.find(event->channel);
        if (found == handlers_.end() && handlers_of_all_.empty()) continue;
        utime_ = event->utime;
        for (const ChannelHandler& handler : handlers_of_all_) {
            ++counters_.received;
            handler(event->channel, event->data);
        }
        if (found == handlers_.end()) return true;
        for (const Handler& handler : found->second) {
            ++counters_.received;
            handler(event->data);
        }
        return true;
    }
    return false;
}

}  // namespace goalmouth
