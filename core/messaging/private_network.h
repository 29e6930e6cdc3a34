#pragma once

#include <string>

namespace goalmouth {

/// Moves this process into a network namespace of its own, in which multicast works over loopback: LCM then
/// runs without any network, heard by nobody but this process and those it starts. There is no way back.
///
/// Needs root, or a kernel that lets users make user namespaces (then the process must not have started a
/// thread yet). Returns "" or, where it is not permitted, a sentence that says what failed.
std::string enter_private_network();

}  // namespace goalmouth
