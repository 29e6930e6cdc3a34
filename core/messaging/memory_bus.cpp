#include "core/messaging/memory_bus.h"

namespace goalmouth {

MemoryHub::MemoryHub() = default;
MemoryHub::~MemoryHub() = default;

MemoryBus& MemoryHub::endpoint(const std::string& name) {
    for (const auto& endpoint : endpoints_) {
        if (endpoint->name() == name) return *endpoint;
    }
    endpoints_.push_back(std::unique_ptr<MemoryBus>(new MemoryBus(*this, name)));
    return *endpoints_.back();
}

bool MemoryHub::run_until_idle() {
    if (running_) return false;
    struct Running {
        bool& flag;
        explicit Running(bool& f) : flag(f) { flag = true; }
        ~Running() { flag = false; }
    } const running(running_);

    bool delivered = false;
    for (;;) {
        while (!waiting_.empty()) {
            const Message message = std::move(waiting_.front());
            waiting_.pop_front();
            for (std::size_t i = 0; i < endpoints_.size(); ++i) delivered |= endpoints_[i]->deliver(message);
        }
        bool newest_delivered = false;
        for (std::size_t i = 0; i < endpoints_.size() && waiting_.empty(); ++i) {
            newest_delivered |= endpoints_[i]->deliver_newest();
        }
        delivered |= newest_delivered;
        if (!newest_delivered && waiting_.empty()) return delivered;
    }
}

void MemoryBus::publish(const std::string& channel, std::span<const std::uint8_t> message) {
    ++counters_.published;
    hub_.waiting_.push_back({channel, {message.begin(), message.end()}});
}

void MemoryBus::subscribe(const std::string& channel, Delivery delivery, Handler handler) {
    subscriptions_.push_back(
        {channel,
         delivery,
         [handler = std::move(handler)](const std::string&, std::span<const std::uint8_t> message) {
             handler(message);
         },
         false,
         {}});
}

void MemoryBus::subscribe_all(ChannelHandler handler) {
    subscriptions_.push_back({"", Delivery::every, std::move(handler), false, {}});
}

bool MemoryBus::dispatch(std::chrono::milliseconds) {
    return hub_.run_until_idle();
}

bool MemoryBus::deliver(const MemoryHub::Message& message) {
    bool delivered = false;
    for (Subscription& subscription : subscriptions_) {
        if (!subscription.channel.empty() && subscription.channel != message.channel) continue;
        if (subscription.delivery == Delivery::newest) {
            if (subscription.waits) ++counters_.superseded;
            subscription.newest = message.bytes;
            subscription.waits = true;
            continue;
        }
        delivered = true;
        call(subscription, message.channel, message.bytes);
    }
    return delivered;
}

// One at a time: what its handler publishes goes first.
bool MemoryBus::deliver_newest() {
    for (Subscription& subscription : subscriptions_) {
        if (!subscription.waits) continue;
        subscription.waits = false;
        call(subscription, subscription.channel, subscription.newest);
        return true;
    }
    return false;
}

void MemoryBus::call(const Subscription& subscription, const std::string& channel,
                     std::span<const std::uint8_t> bytes) {
    ++counters_.received;
    const auto start = std::chrono::steady_clock::now();
    subscription.handler(channel, bytes);
    time_spent_ += std::chrono::steady_clock::now() - start;
}

}  // namespace goalmouth
