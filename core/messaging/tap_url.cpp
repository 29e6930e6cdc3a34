#include "core/messaging/tap_url.h"

#include "core/messaging/multicast.h"

#include <algorithm>
#include <stdexcept>

namespace goalmouth {
namespace {

/// "udpm://GROUP:PORT?OPTIONS" with another port.
std::string with_port(const std::string& url, int port) {
    const std::size_t network = url.find("://") + 3;
    const std::size_t query = std::min(url.find('?', network), url.size());
    const std::size_t colon = std::min(url.find(':', network), query);
    std::string group = url.substr(network, colon - network);
    if (group.empty()) group = "239.255.76.67";
    return url.substr(0, network) + group + ":" + std::to_string(port) + url.substr(query);
}

}  // namespace

std::string tap_url(const std::string& graph_url, const std::string& setting) {
    const std::string graph = effective_lcm_url(graph_url);
    if (setting == "graph") return graph;
    if (setting != "own") {
        if (setting.find("://") == std::string::npos)
            throw std::invalid_argument("'" + setting + "' is not an LCM URL; valid: own, graph, or e.g. " +
                                        default_lcm_url);
        if (setting != graph && same_traffic(graph, setting)) {
            throw std::invalid_argument(
                "'" + setting + "' has the port of the graph's own " + graph +
                ": whoever listens to a port hears every group on it; give it another port, or write: graph");
        }
        return setting;
    }
    const int port = udp_port(graph);
    if (port == 0) return graph;
    if (port + tap_port_distance > 65535) {
        throw std::invalid_argument("the graph's port " + std::to_string(port) + " + " +
                                    std::to_string(tap_port_distance) +
                                    " is no port; give the graph one of at most " +
                                    std::to_string(65535 - tap_port_distance) + ", or the tap a URL");
    }
    return with_port(graph, port + tap_port_distance);
}

bool same_traffic(const std::string& one_url, const std::string& other_url) {
    const std::string one = effective_lcm_url(one_url);
    const std::string other = effective_lcm_url(other_url);
    if (one == other) return true;
    const int port = udp_port(one);
    return port != 0 && port == udp_port(other);
}

}  // namespace goalmouth
