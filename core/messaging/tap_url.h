#pragma once

#include <string>

namespace goalmouth {

/// How far above the graph's UDP port its tap's stands. Robots on one network count their ports up one by
/// one, so it is not 1: the taps of thousand neighbours meet nobody.
inline constexpr int tap_port_distance = 1000;

/// Where a tap publishes, seen from the LCM URL of its graph ("" = LCM's default). `setting`:
///
///     "own"     the same group and options, on the graph's port + 1000; the graph's own URL where it does
///               not go by UDP, as a server of tcpq hands out only what is asked for
///     "graph"   the graph's own URL
///     a URL     that one
///
/// Throws std::invalid_argument, with what would be valid, for a port above 65535 and for the graph's port
/// under another group: LCM's sockets hear a port whatever the group.
std::string tap_url(const std::string& graph_url, const std::string& setting = "own");

/// Whoever listens on one of the URLs hears the other as well.
bool same_traffic(const std::string& one_url, const std::string& other_url);

}  // namespace goalmouth
