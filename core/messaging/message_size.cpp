#include "core/messaging/message_size.h"

#include "core/messaging/multicast.h"

#include <algorithm>
#include <charconv>
#include <sys/socket.h>
#include <unistd.h>

namespace goalmouth {
namespace {

constexpr std::size_t lcm_datagram = 65499;
constexpr std::size_t lcm_largest = std::size_t{1} << 28;  // receivers refuse more
constexpr std::size_t stock_buffer = 212992;
constexpr double share_that_arrives = 0.7;  // of the buffer: 150 kB of 208 KiB

std::size_t receive_buffer_of(int socket) {
    int bytes = 0;
    socklen_t length = sizeof bytes;
    if (getsockopt(socket, SOL_SOCKET, SO_RCVBUF, &bytes, &length) != 0 || bytes <= 0) return stock_buffer;
    return static_cast<std::size_t>(bytes);
}

bool leaves_the_machine(const std::string& lcm_url) {
    const auto option = lcm_url.find("ttl=");
    int ttl = 0;
    if (option != std::string::npos)
        std::from_chars(lcm_url.data() + option + 4, lcm_url.data() + lcm_url.size(), ttl);
    return ttl > 0;
}

std::string bytes_text(std::size_t bytes) {
    return std::to_string(bytes) + " bytes";
}

std::string remedy(std::size_t bytes) {
    const std::string smaller =
        "Make it smaller (scan-lines: a larger spacing; images: shared memory, or the slices the tap sends)";
    if (bytes > lcm_largest) return smaller;  // whatever the buffers
    const std::string room = std::to_string(2 * bytes);
    return smaller + ", or give receivers room, as root: sysctl -w net.core.rmem_max=" + room +
           " net.core.rmem_default=" + room;
}

}  // namespace

ReceiveBuffers receive_buffers() {
    ReceiveBuffers buffers{stock_buffer, 2 * stock_buffer};
    const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (fd < 0) return buffers;
    buffers.usual = receive_buffer_of(fd);
    const int most = 1 << 30;
    setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &most, sizeof most);
    buffers.largest = std::max(buffers.usual, receive_buffer_of(fd));
    close(fd);
    return buffers;
}

SizeLimits size_limits(const std::string& lcm_url) {
    const std::string url = effective_lcm_url(lcm_url);
    SizeLimits limits;
    if (udp_port(url) == 0) return limits;
    limits.buffers = receive_buffers();
    limits.datagram = lcm_datagram;
    limits.deliverable = leaves_the_machine(url)
                             ? lcm_largest
                             : std::min(lcm_largest, std::max(limits.buffers.largest, lcm_datagram));
    return limits;
}

std::string oversized_text(std::size_t bytes, const SizeLimits& limits) {
    const std::size_t fragments = (bytes + lcm_datagram - 1) / lcm_datagram;
    const auto lost_from =
        static_cast<std::size_t>(share_that_arrives * static_cast<double>(limits.buffers.usual));
    std::string text = "a message of " + bytes_text(bytes) + " is more than the " +
                       bytes_text(limits.datagram) + " of a datagram: LCM sends " +
                       std::to_string(fragments) + " fragments, and whoever loses one loses the message";
    text += ", as happens to nearly every message above " + bytes_text(lost_from) +
            " with receive buffers of " + bytes_text(limits.buffers.usual) + " as here";
    return text + ". " + remedy(bytes) + " (said once; counted as oversized)";
}

std::string undeliverable_text(std::size_t bytes, const SizeLimits& limits) {
    const std::string why = bytes > lcm_largest
                                ? "LCM receives " + bytes_text(lcm_largest) + " at most"
                                : "the largest receive buffer that a program can have here holds " +
                                      bytes_text(limits.deliverable);
    return "not sent: a message of " + bytes_text(bytes) + " would hardly ever arrive: " + why + ". " +
           remedy(bytes);
}

}  // namespace goalmouth
