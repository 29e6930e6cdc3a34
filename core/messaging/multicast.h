#pragma once

#include <string>

namespace goalmouth {

/// Whether a datagram sent to the multicast group of an LCM URL comes back on this machine, asked with
/// sockets of our own on a port nobody uses: within 500 ms, where LCM's self-test takes up to ten seconds.
/// The empty URL is LCM's default
/// ($LCM_DEFAULT_URL included). True for URLs that need no multicast (memq, file, tcpq).
bool multicast_works(const std::string& lcm_url = "");

/// UDP port of an LCM URL, LCM's default where it names none; 0 for URLs that do not go by UDP.
int udp_port(const std::string& lcm_url);

/// How full, 0…1, the fullest receive buffer of the UDP sockets on this port is, all processes of this
/// machine counted; stock buffers assumed (net.core.rmem_default). A buffer that stays full belongs to a
/// process that does not read. 0 where the system does not say.
double fullest_receive_buffer(int port);

/// What to do about it, for error messages: a sentence with the commands.
std::string multicast_advice();

}  // namespace goalmouth
