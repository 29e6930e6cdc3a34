#pragma once

#include "core/messaging/bus.h"
#include "core/messaging/encoded_form.h"
#include "core/messaging/validation.h"

#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace goalmouth {

/// Encodes and sends. A message that validation.h refuses is not sent but counted as rejected: every receiver
/// would refuse it, and generated encoders read beyond arrays that are shorter than their size field says.
template <class Message>
void publish(Bus& bus, const std::string& channel, const Message& message) {
    if (const auto cause = problem(message)) {
        bus.reject(channel, "not published: " + *cause);
        return;
    }
    thread_local std::vector<std::uint8_t> bytes;
    bytes.resize(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    bus.publish(channel, bytes);
}

/// Whether bytes begin as every encoded Message does.
template <class Message>
bool has_hash(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < 8) return false;
    std::uint64_t hash = 0;
    for (const std::uint8_t byte : bytes.first(8)) hash = (hash << 8) | byte;
    return hash == static_cast<std::uint64_t>(Message::getHash());
}

/// Decodes bytes into a message, or says why they are none. Generated decoders may throw on absurd lengths.
template <class Message>
std::optional<std::string> decode(std::span<const std::uint8_t> bytes, Message& message) {
    if (!has_hash<Message>(bytes)) return std::string("not of type ") + Message::getTypeName();
    if (!lengths_add_up(message, bytes))
        return std::string("impossible sizes in type ") + Message::getTypeName();
    try {
        const int size = static_cast<int>(bytes.size());
        if (message.decode(bytes.data(), 0, size) != size)
            return std::string("impossible sizes in type ") + Message::getTypeName();
    } catch (const std::exception&) {
        return std::string("impossible sizes in type ") + Message::getTypeName();
    }
    return problem(message);
}

/// Calls `handler(const Message&)` for each message that decodes and passes validation.h; the rest is counted
/// and skipped.
template <class Message, class F>
void subscribe(Bus& bus, const std::string& channel, F handler, Delivery delivery = Delivery::every) {
    bus.subscribe(channel, delivery,
                  [&bus, channel, handler = std::move(handler)](std::span<const std::uint8_t> bytes) mutable {
                      Message message{};
                      if (const auto cause = decode(bytes, message)) {
                          bus.reject(channel, *cause);
                          return;
                      }
                      handler(std::as_const(message));
                  });
}

}  // namespace goalmouth
