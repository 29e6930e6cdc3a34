#pragma once

#include <cstddef>
#include <limits>
#include <string>

namespace goalmouth {

/// What UDP receive buffers hold on this machine, in the kernel's own reckoning: net.core.rmem_default for
/// sockets that ask for nothing, as LCM's do, and twice net.core.rmem_max for those that ask for all they can
/// get (recv_buf_size in the LCM URL). Asked of a socket, since /proc shows neither inside a network
/// namespace.
struct ReceiveBuffers {
    std::size_t usual = 0;
    std::size_t largest = 0;  // ≥ usual
};
ReceiveBuffers receive_buffers();

/// Sizes, channel name and its end included, above which messages of LCM 1.3.1 fare badly. No limit for
/// providers other than UDP.
struct SizeLimits {
    /// One datagram. Above it LCM sends fragments of this size, as fast as it can: a receiver that is not
    /// scheduled at once drops some, and the message with them. With stock buffers of 208 KiB 97 to 100 % of
    /// messages above 150 kB are lost, with 4 MiB a fifth of those of 6 MB.
    std::size_t datagram = std::numeric_limits<std::size_t>::max();
    /// The largest that may be received: what the largest receive buffer of this machine holds, where nothing
    /// leaves it (ttl 0); LCM's own limit elsewhere.
    std::size_t deliverable = std::numeric_limits<std::size_t>::max();
    ReceiveBuffers buffers;
};
SizeLimits size_limits(const std::string& lcm_url);

/// Sentences for people: what happens to a message of so many bytes, and what to do about it.
std::string oversized_text(std::size_t bytes, const SizeLimits& limits);
std::string undeliverable_text(std::size_t bytes, const SizeLimits& limits);

}  // namespace goalmouth
