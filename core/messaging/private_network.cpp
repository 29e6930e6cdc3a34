#include "core/messaging/private_network.h"

#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <net/if.h>
#include <net/route.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace goalmouth {
namespace {

std::string failure(const std::string& what) {
    return what + ": " + std::strerror(errno);
}

bool write_file(const char* path, const std::string& text) {
    const int fd = open(path, O_WRONLY | O_CLOEXEC);
    if (fd < 0) return false;
    const bool written = write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    close(fd);
    return written;
}

/// Inside a new user namespace the user stays who he was.
std::string keep_identity(uid_t uid, gid_t gid) {
    const std::string user = std::to_string(uid);
    const std::string group = std::to_string(gid);
    if (!write_file("/proc/self/setgroups", "deny")) return failure("cannot write /proc/self/setgroups");
    if (!write_file("/proc/self/uid_map", user + " " + user + " 1"))
        return failure("cannot write /proc/self/uid_map");
    if (!write_file("/proc/self/gid_map", group + " " + group + " 1"))
        return failure("cannot write /proc/self/gid_map");
    return "";
}

std::string bring_loopback_up(int fd) {
    ifreq interface {};
    std::strncpy(interface.ifr_name, "lo", IFNAMSIZ - 1);
    if (ioctl(fd, SIOCGIFFLAGS, &interface) != 0) return failure("no loopback interface");
    interface.ifr_flags = static_cast<short>(interface.ifr_flags | IFF_UP | IFF_RUNNING);
    if (ioctl(fd, SIOCSIFFLAGS, &interface) != 0) return failure("cannot bring the loopback interface up");
    return "";
}

std::string route_multicast_over_loopback(int fd) {
    rtentry route{};
    const auto address = [](sockaddr& where, const char* text) {
        auto& in = reinterpret_cast<sockaddr_in&>(where);
        in.sin_family = AF_INET;
        inet_pton(AF_INET, text, &in.sin_addr);
    };
    address(route.rt_dst, "224.0.0.0");
    address(route.rt_genmask, "240.0.0.0");
    char device[] = "lo";
    route.rt_dev = device;
    route.rt_flags = RTF_UP;
    if (ioctl(fd, SIOCADDRT, &route) != 0 && errno != EEXIST) return failure("cannot add a multicast route");
    return "";
}

}  // namespace

std::string enter_private_network() {
    const uid_t uid = geteuid();
    const gid_t gid = getegid();
    if (unshare(CLONE_NEWNET) != 0) {
        if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) {
            return failure(
                "a private network is not permitted (neither as this user nor in a user namespace)");
        }
        if (auto problem = keep_identity(uid, gid); !problem.empty()) return problem;
    }
    const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (fd < 0) return failure("cannot open a socket in the private network");
    std::string problem = bring_loopback_up(fd);
    if (problem.empty()) problem = route_multicast_over_loopback(fd);
    close(fd);
    return problem;
}

}  // namespace goalmouth
