#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>

namespace goalmouth {

/// What a bus did since it was made. `rejected` holds, for each channel and cause, how many messages were
/// refused.
struct BusCounters {
    std::int64_t received = 0;    // messages handed to handlers or refused
    std::int64_t published = 0;   // messages sent
    std::int64_t oversized = 0;   // of those, more than one datagram carries (LcmBus::publish)
    std::int64_t superseded = 0;  // messages of `newest` subscriptions passed over for a newer one
    std::map<std::string, std::int64_t> rejected;

    std::int64_t rejected_total() const;
};

/// Which messages a subscription gets when several wait.
enum class Delivery {
    every,   // each one, in the order of arrival
    newest,  // the last one only, once nothing else waits; the others are counted as superseded
};

/// Messages between modules: bytes on named channels. Three kinds exist: LcmBus (any LCM URL), MemoryBus (one
/// process, deterministic) and LogBus (an LCM log file). A module holds a Bus and never knows which.
///
/// One thread: subscribe first, then dispatch from the thread that made the bus. Handlers run inside dispatch
/// and may publish. A subscription lasts as long as the bus.
///
/// Most code uses the typed functions of typed.h, which encode, decode and validate.
class Bus {
  public:
    using Handler = std::function<void(std::span<const std::uint8_t> message)>;
    using ChannelHandler =
        std::function<void(const std::string& channel, std::span<const std::uint8_t> message)>;

    Bus() = default;
    Bus(const Bus&) = delete;
    Bus& operator=(const Bus&) = delete;
    virtual ~Bus() = default;

    /// Sends one message. Throws std::runtime_error where the transport refuses it for good (a full disk
    /// under a log); a message the network loses is lost silently: carry a seq. What cannot arrive because of
    /// its size is counted as rejected.
    virtual void publish(const std::string& channel, std::span<const std::uint8_t> message) = 0;

    /// `channel` is the exact name.
    virtual void subscribe(const std::string& channel, Delivery delivery, Handler handler) = 0;

    /// Every message of every channel, what this bus itself publishes included where it comes back.
    virtual void subscribe_all(ChannelHandler handler) = 0;

    /// Waits up to `timeout` for a message, then delivers all that wait: `every` handlers in order of
    /// arrival, then the `newest` ones. Returns early, without delivering, when a signal interrupts the wait.
    /// True if anything was delivered.
    virtual bool dispatch(std::chrono::milliseconds timeout) = 0;

    /// How full the fullest receive buffer is that hears this bus, 0…1: who sends much can wait for listeners
    /// that are behind. 0 where it is not known.
    virtual double congestion() const { return 0.0; }

    const BusCounters& counters() const { return counters_; }

    /// Counts a message that did not decode or makes no sense; logs the first of each channel and cause.
    void reject(const std::string& channel, const std::string& cause);

  protected:
    BusCounters counters_;
};

}  // namespace goalmouth
