#include "core/messaging/lcm_bus.h"

#include "core/messaging/multicast.h"
#include "core/messaging/signals_blocked.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fmt/format.h>
#include <poll.h>
#include <span>
#include <stdexcept>
#include <utility>

#include <lcm/lcm-cpp.hpp>
#include <spdlog/spdlog.h>

namespace goalmouth {
namespace {

constexpr int queue_capacity = 1000;  // messages of one subscription; a raw 640×480 frame is about 20 slices
constexpr int messages_per_dispatch = 1000;
constexpr const char* self_test_channel = "LCM_SELF_TEST";  // each LCM that starts to listen sends one
constexpr std::chrono::milliseconds time_per_dispatch{50};

void check_name(const std::string& channel) {
    if (channel.empty() || channel.size() > LCM_MAX_CHANNEL_NAME_LENGTH) {
        throw std::invalid_argument("channel name \"" + channel + "\": an LCM channel name has 1 to " +
                                    std::to_string(LCM_MAX_CHANNEL_NAME_LENGTH) + " characters");
    }
}

/// LCM takes an anchored regular expression where we mean a name.
std::string as_expression(const std::string& name) {
    std::string expression;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80 && std::isalnum(byte) == 0 && c != '_') expression += '\\';
        expression += c;
    }
    return expression;
}

}  // namespace

struct LcmBus::Receiver {
    static void receive(const lcm::ReceiveBuffer* buffer, const std::string& channel,
                        Subscription* subscription) {
        LcmBus& bus = *subscription->bus;
        const auto* bytes = static_cast<const std::uint8_t*>(buffer->data);
        subscription->channel = channel;
        subscription->message.assign(bytes, bytes + buffer->data_size);
        if (subscription->delivery == Delivery::every) {
            ++bus.counters_.received;
            bus.arrived_.push_back(subscription);
            return;
        }
        if (subscription->waits) ++bus.counters_.superseded;
        subscription->waits = true;
    }
};

LcmBus::LcmBus(const std::string& url) : port_(udp_port(url)), sizes_(size_limits(url)) {
    const std::string name = url.empty() ? "LCM's default URL" : "LCM URL \"" + url + "\"";
    if (!multicast_works(url)) throw std::runtime_error(name + ": " + multicast_advice());
    const SignalsBlocked blocked;  // a signal must interrupt the thread that dispatches
    lcm_ = std::make_unique<lcm::LCM>(url);
    if (!lcm_->good()) {
        throw std::runtime_error(name +
                                 ": LCM cannot use it; valid is e.g. \"udpm://239.255.76.67:7667?ttl=0\"");
    }
}

LcmBus::~LcmBus() = default;

/// Whether a message is too large to be sent; says once a channel what is wrong with large ones.
bool LcmBus::size_refused(const std::string& channel, std::size_t bytes) {
    if (bytes <= sizes_.datagram) return false;
    if (bytes > sizes_.deliverable) {
        const auto refusal = refusals_.try_emplace(channel, undeliverable_text(bytes, sizes_)).first;
        reject(channel, refusal->second);
        return true;
    }
    ++counters_.oversized;
    if (oversized_.insert(channel).second)
        spdlog::warn(fmt::format("{}: {}", channel, oversized_text(bytes, sizes_)));
    return false;
}

void LcmBus::publish(const std::string& channel, std::span<const std::uint8_t> message) {
    check_name(channel);
    if (size_refused(channel, channel.size() + 1 + message.size())) return;
    const SignalsBlocked blocked;  // the first publish may start LCM's thread
    if (lcm_->publish(channel, message.data(), static_cast<unsigned int>(message.size())) == 0) {
        ++counters_.published;
    } else if (!failure_logged_) {
        failure_logged_ = true;
        spdlog::warn(
            fmt::format("{}: LCM could not send a message of {} bytes (said once)", channel, message.size()));
    }
}

void LcmBus::subscribe(const std::string& channel, Delivery delivery, Handler handler) {
    check_name(channel);
    listen(as_expression(channel), delivery,
           [handler = std::move(handler)](const std::string&, std::span<const std::uint8_t> message) {
               handler(message);
           });
}

void LcmBus::subscribe_all(ChannelHandler handler) {
    listen(".*", Delivery::every,
           [handler = std::move(handler)](const std::string& channel, std::span<const std::uint8_t> message) {
               if (!channel.empty() && channel != self_test_channel) handler(channel, message);
           });
}

void LcmBus::listen(const std::string& expression, Delivery delivery, ChannelHandler handler) {
    const SignalsBlocked blocked;
    Subscription& subscription = subscriptions_.emplace_back();
    subscription.bus = this;
    subscription.delivery = delivery;
    subscription.handler = std::move(handler);
    lcm::Subscription* made = lcm_->subscribeFunction(expression, &Receiver::receive, &subscription);
    if (made == nullptr) throw std::runtime_error("cannot subscribe to channel " + expression);
    made->setQueueCapacity(queue_capacity);
}

double LcmBus::congestion() const {
    return port_ == 0 ? 0.0 : fullest_receive_buffer(port_);
}

bool LcmBus::wait(std::chrono::milliseconds timeout) const {
    pollfd readable{lcm_->getFileno(), POLLIN, 0};
    const auto limit = std::clamp<std::chrono::milliseconds::rep>(timeout.count(), 0, 1'000'000'000);
    return poll(&readable, 1, static_cast<int>(limit)) > 0;
}

// Handlers run here and not in LCM's callback: an exception must not pass through LCM's C code.
void LcmBus::deliver_every() {
    for (Subscription* subscription : arrived_)
        subscription->handler(subscription->channel, subscription->message);
}

bool LcmBus::deliver_newest() {
    bool delivered = false;
    for (Subscription& subscription : subscriptions_) {
        if (!subscription.waits) continue;
        subscription.waits = false;
        delivered = true;
        ++counters_.received;
        subscription.handler(subscription.channel, subscription.message);
    }
    return delivered;
}

bool LcmBus::dispatch(std::chrono::milliseconds timeout) {
    if (subscriptions_.empty()) {
        poll(nullptr, 0,
             static_cast<int>(std::clamp<std::chrono::milliseconds::rep>(timeout.count(), 0, 1'000'000'000)));
        return false;
    }
    if (!wait(timeout)) return false;
    bool delivered = false;
    const auto stop = std::chrono::steady_clock::now() + time_per_dispatch;
    for (int taken = 0; taken < messages_per_dispatch; ++taken) {
        arrived_.clear();
        if (!wait(std::chrono::milliseconds(0)) || lcm_->handleTimeout(0) <= 0) break;
        delivered = delivered || !arrived_.empty();
        deliver_every();
        if (std::chrono::steady_clock::now() >= stop) break;
    }
    return deliver_newest() || delivered;
}

}  // namespace goalmouth
