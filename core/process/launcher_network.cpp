#include "core/messaging/multicast.h"
#include "core/messaging/private_network.h"
#include "core/process/launcher.h"

#include <filesystem>
#include <unistd.h>

namespace goalmouth {
namespace {

const char* const by_hand =
    "give the host a multicast route (as root: ip link set lo up; ip route add 224.0.0.0/4 dev lo), or a "
    "network for this run alone "
    "(as root: unshare --net sh -c 'ip link set lo up; ip route add 224.0.0.0/4 dev lo; exec goalmouth …')";

std::string user_namespace() {
    std::error_code ignored;
    return std::filesystem::read_symlink("/proc/self/ns/user", ignored).string();
}

}  // namespace

std::string provide_network(const std::string& lcm_url, NetworkChoice choice) {
    if (choice != NetworkChoice::separate) {
        if (multicast_works(lcm_url)) return {};
        if (choice == NetworkChoice::host) {
            throw ConfigurationError("--network: multicast to " + lcm_url +
                                     " does not work on this host; valid: --network "
                                     "auto or private, or " +
                                     by_hand);
        }
    }
    const std::string users_before = user_namespace();
    std::string problem = enter_private_network();
    if (problem.empty() && !multicast_works(lcm_url)) problem = "multicast does not work in it either";
    if (!problem.empty()) {
        throw ConfigurationError("--network: a network of its own for the graph: " + problem + "; " +
                                 by_hand);
    }
    const bool other_user = user_namespace() != users_before;
    return std::string(choice == NetworkChoice::separate ? "" : "multicast does not work on this host: ") +
           "the graph has a network of its own; from another terminal: nsenter --target " +
           std::to_string(::getpid()) + (other_user ? " --user --preserve-credentials" : "") +
           " --net goalmouth spy";
}

}  // namespace goalmouth
