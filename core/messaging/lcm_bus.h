#pragma once

#include "core/messaging/bus.h"
#include "core/messaging/message_size.h"

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace lcm {
class LCM;
}

namespace goalmouth {

/// Messages over LCM, by any LCM URL ("" is LCM's default; "udpm://239.255.76.67:7667?ttl=0", "memq://",
/// "tcpq://…").
///
/// Each subscription queues up to 1000 messages between two dispatches. One dispatch delivers what waits, but
/// stops after 50 ms or 1000 messages and leaves the rest to the next, so that a flood starves nobody. A
/// handler may throw: the exception leaves dispatch.
class LcmBus : public Bus {
  public:
    /// Throws std::runtime_error, with what to do, where the URL is wrong or multicast does not work.
    explicit LcmBus(const std::string& url = "");
    ~LcmBus() override;

    /// By UDP, a message larger than a datagram goes in fragments, which are lost together: that is said once
    /// for each channel, and counted. One that no receiver can hold is not sent, but counted as rejected.
    /// Both sentences say what to do; message_size.h has the limits.
    void publish(const std::string& channel, std::span<const std::uint8_t> message) override;
    void subscribe(const std::string& channel, Delivery delivery, Handler handler) override;
    /// Without LCM's own messages to itself.
    void subscribe_all(ChannelHandler handler) override;
    bool dispatch(std::chrono::milliseconds timeout) override;
    /// Of the UDP sockets of this machine on the URL's port; 0 for other providers.
    double congestion() const override;

  private:
    struct Subscription {
        LcmBus* bus = nullptr;
        Delivery delivery = Delivery::every;
        ChannelHandler handler;
        std::string channel;                // that `message` came on
        bool waits = false;                 // newest: `message` is to be delivered
        std::vector<std::uint8_t> message;  // newest: the last one; every: the one being delivered
    };
    struct Receiver;  // LCM's callback

    bool wait(std::chrono::milliseconds timeout) const;
    void deliver_every();
    bool deliver_newest();
    void listen(const std::string& expression, Delivery delivery, ChannelHandler handler);
    bool size_refused(const std::string& channel, std::size_t bytes);

    int port_;  // UDP, 0 for other providers
    SizeLimits sizes_;
    std::unique_ptr<lcm::LCM> lcm_;
    std::deque<Subscription> subscriptions_;  // LCM keeps pointers to its elements
    std::vector<Subscription*> arrived_;      // `every` subscriptions that the message just handled is for
    bool failure_logged_ = false;
    std::set<std::string> oversized_;              // channels of which that was said
    std::map<std::string, std::string> refusals_;  // channel → words for reject()
};

}  // namespace goalmouth
