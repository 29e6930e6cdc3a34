#pragma once

#include <string>

namespace goalmouth {

/// LCM's own: its group and port, and nothing leaves the host.
inline constexpr const char* default_lcm_url = "udpm://239.255.76.67:7667?ttl=0";

/// The URL that LCM goes by, given this one: where it is empty, $LCM_DEFAULT_URL; where that is not set or
/// empty, default_lcm_url. The functions below take URLs as they are given to LCM, empty ones too.
std::string effective_lcm_url(const std::string& lcm_url);

/// Whether a datagram sent to the multicast group of an LCM URL comes back on this machine, asked with
/// sockets of our own on a port nobody uses: within 500 ms, where LCM's self-test takes up to ten seconds.
/// True for URLs that need no multicast (memq, file, tcpq).
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
