#include "tests/graph/garbage.h"

#include <algorithm>
#include <arpa/inet.h>
#include <cstdint>
#include <netinet/in.h>
#include <random>
#include <stdexcept>
#include <sys/socket.h>
#include <unistd.h>

namespace goalmouth::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

void append_number(Bytes& bytes, std::uint32_t number) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

}  // namespace

void send_garbage(const std::vector<std::string>& channels, int rounds) {
    const int out = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (out < 0) throw std::runtime_error("no socket");
    const unsigned char ttl = 0;
    ::setsockopt(out, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
    sockaddr_in group{};
    group.sin_family = AF_INET;
    group.sin_port = htons(7667);
    ::inet_pton(AF_INET, "239.255.76.67", &group.sin_addr);
    const auto send = [&](const Bytes& bytes) {
        ::sendto(out, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&group), sizeof group);
    };
    std::mt19937 random(1);
    const auto noise = [&](std::size_t size) {
        Bytes bytes(size);
        std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<std::uint8_t>(random()); });
        return bytes;
    };
    for (int round = 0; round < rounds; ++round) {
        send(noise(random() % 1400));
        for (const auto& channel : channels) {
            for (const std::size_t size : {std::size_t{0}, std::size_t{8}, std::size_t{200}}) {
                Bytes packet;
                append_number(packet, 0x4c433032);  // LCM's mark of a message in one datagram
                append_number(packet, static_cast<std::uint32_t>(round));
                packet.insert(packet.end(), channel.begin(), channel.end());
                packet.push_back(0);
                const Bytes content = noise(size);
                packet.insert(packet.end(), content.begin(), content.end());
                send(packet);
            }
        }
    }
    ::close(out);
}

}  // namespace goalmouth::test
