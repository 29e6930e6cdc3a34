#pragma once

#include "core/messaging/bus.h"

#include <chrono>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace goalmouth {

class MemoryBus;

/// A network inside one process, without threads or waiting: same messages in, same order of everything out.
///
/// Messages are delivered in the order they were published; one message goes to the endpoints in the order
/// they were made, its sender included, as with LCM. Messages of `newest` subscriptions wait until no other
/// message is left.
class MemoryHub {
  public:
    MemoryHub();
    ~MemoryHub();
    MemoryHub(const MemoryHub&) = delete;
    MemoryHub& operator=(const MemoryHub&) = delete;

    /// The endpoint of that name, made at the first call; lives as long as the hub.
    MemoryBus& endpoint(const std::string& name);

    /// Delivers until nothing waits, messages published meanwhile included. True if anything was delivered.
    /// Called from inside a handler it does nothing. An exception of a handler leaves; what waits stays.
    bool run_until_idle();

  private:
    friend class MemoryBus;
    struct Message {
        std::string channel;
        std::vector<std::uint8_t> bytes;
    };

    std::vector<std::unique_ptr<MemoryBus>> endpoints_;
    std::deque<Message> waiting_;
    bool running_ = false;
};

/// One module's place on a MemoryHub.
class MemoryBus : public Bus {
  public:
    void publish(const std::string& channel, std::span<const std::uint8_t> message) override;
    void subscribe(const std::string& channel, Delivery delivery, Handler handler) override;
    void subscribe_all(ChannelHandler handler) override;
    /// Delivers what waits on the whole hub; never waits itself.
    bool dispatch(std::chrono::milliseconds timeout) override;

    const std::string& name() const { return name_; }
    /// Time this endpoint's handlers took in all.
    std::chrono::nanoseconds time_spent() const { return time_spent_; }

  private:
    friend class MemoryHub;
    struct Subscription {
        std::string channel;  // "" = each
        Delivery delivery = Delivery::every;
        ChannelHandler handler;
        bool waits = false;
        std::vector<std::uint8_t> newest;
    };

    MemoryBus(MemoryHub& hub, std::string name) : hub_(hub), name_(std::move(name)) {}
    bool deliver(const MemoryHub::Message& message);
    bool deliver_newest();
    void call(const Subscription& subscription, const std::string& channel,
              std::span<const std::uint8_t> bytes);

    MemoryHub& hub_;
    std::string name_;
    std::deque<Subscription> subscriptions_;
    std::chrono::nanoseconds time_spent_{0};
};

}  // namespace goalmouth
