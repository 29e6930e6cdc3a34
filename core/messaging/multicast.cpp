#include "core/messaging/multicast.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <netinet/in.h>
#include <poll.h>
#include <random>
#include <sys/socket.h>
#include <unistd.h>

namespace goalmouth {
namespace {

class Socket {
  public:
    Socket() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}
    ~Socket() {
        if (fd_ >= 0) close(fd_);
    }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;
    int fd() const { return fd_; }
    bool good() const { return fd_ >= 0; }

  private:
    int fd_;
};

bool goes_by_udp(const std::string& url) {
    return url.starts_with("udpm:") || url.starts_with("mpudpm:");
}

/// "udpm://239.255.76.67:7667?ttl=0" → "239.255.76.67"; LCM's own group where the URL names none.
std::string group_of(const std::string& url) {
    const std::size_t begin = url.find("://");
    if (begin == std::string::npos) return "239.255.76.67";
    const std::string rest = url.substr(begin + 3);
    const std::string group = rest.substr(0, rest.find_first_of(":?"));
    return group.empty() ? "239.255.76.67" : group;
}

bool comes_back(int receiver, const std::array<char, 16>& sent,
                std::chrono::steady_clock::time_point deadline) {
    for (;;) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now())
                .count();
        pollfd wait{receiver, POLLIN, 0};
        const int ready = poll(&wait, 1, static_cast<int>(std::max<long>(left, 0)));
        if (ready < 0 && errno == EINTR && left > 0) continue;
        if (ready <= 0) return false;
        std::array<char, 16> got{};
        const ssize_t size = recv(receiver, got.data(), got.size(), MSG_DONTWAIT);
        if (size == static_cast<ssize_t>(got.size()) && got == sent) return true;
    }
}

}  // namespace

std::string effective_lcm_url(const std::string& lcm_url) {
    if (!lcm_url.empty()) return lcm_url;
    const char* variable = std::getenv("LCM_DEFAULT_URL");
    return variable != nullptr && *variable != '\0' ? variable : default_lcm_url;
}

bool multicast_works(const std::string& lcm_url) {
    const std::string url = effective_lcm_url(lcm_url);
    if (!goes_by_udp(url)) return true;

    sockaddr_in group{};
    group.sin_family = AF_INET;
    if (inet_pton(AF_INET, group_of(url).c_str(), &group.sin_addr) != 1) return false;

    Socket receiver;
    Socket sender;
    if (!receiver.good() || !sender.good()) return false;
    sockaddr_in any{};
    any.sin_family = AF_INET;
    any.sin_addr.s_addr = htonl(INADDR_ANY);
    if (bind(receiver.fd(), reinterpret_cast<const sockaddr*>(&any), sizeof any) != 0) return false;
    socklen_t length = sizeof any;
    if (getsockname(receiver.fd(), reinterpret_cast<sockaddr*>(&any), &length) != 0) return false;
    ip_mreq membership{};
    membership.imr_multiaddr = group.sin_addr;
    if (setsockopt(receiver.fd(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) != 0)
        return false;

    const unsigned char ttl = 0;
    setsockopt(sender.fd(), IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
    group.sin_port = any.sin_port;
    std::array<char, 16> probe{};
    std::random_device random;
    for (char& c : probe) c = static_cast<char>(random());
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(500);
    if (sendto(sender.fd(), probe.data(), probe.size(), 0, reinterpret_cast<const sockaddr*>(&group),
               sizeof group) != static_cast<ssize_t>(probe.size())) {
        return false;
    }
    return comes_back(receiver.fd(), probe, deadline);
}

int udp_port(const std::string& lcm_url) {
    constexpr int usual_port = 7667;
    const std::string url = effective_lcm_url(lcm_url);
    if (!goes_by_udp(url)) return 0;
    const std::size_t begin = url.find("://");
    const std::size_t colon = begin == std::string::npos ? begin : url.find(':', begin + 3);
    int port = usual_port;
    if (colon != std::string::npos) std::from_chars(url.data() + colon + 1, url.data() + url.size(), port);
    return port;
}

double fullest_receive_buffer(int port) {
    static const double capacity = [] {
        double bytes = 212992.0;
        std::ifstream("/proc/sys/net/core/rmem_default") >> bytes;
        return std::max(bytes, 1.0);
    }();
    // "  52: 00000000:1DF3 00000000:0000 07 00000000:00034000 …": number, local address, remote address,
    // state, queues
    std::ifstream table("/proc/net/udp");
    std::string line;
    std::getline(table, line);
    double fullest = 0.0;
    while (std::getline(table, line)) {
        unsigned int local_port = 0;
        unsigned int waiting = 0;
        if (std::sscanf(line.c_str(), " %*d: %*x:%x %*x:%*x %*x %*x:%x", &local_port, &waiting) != 2)
            continue;
        if (local_port == static_cast<unsigned int>(port)) fullest = std::max(fullest, waiting / capacity);
    }
    return std::min(fullest, 1.0);
}

std::string multicast_advice() {
    return "this machine has no multicast route. As root: \"ip link set lo up; "
           "ip route add 224.0.0.0/4 dev lo\"; "
           "or let the graph have a network of its own: \"goalmouth launch --network private\"";
}

}  // namespace goalmouth
