#pragma once

#include <string>
#include <vector>

namespace goalmouth::test {

/// Sends to group and port of LCM's default URL: noise, and well-formed LCM packets of each channel with
/// noise inside, `rounds` times.
void send_garbage(const std::vector<std::string>& channels, int rounds);

}  // namespace goalmouth::test
