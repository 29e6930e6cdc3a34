#pragma once

#include "core/messaging/private_network.h"

#include <string>

#include <gtest/gtest.h>

namespace goalmouth::test {

/// Once a process: a network of its own, so that tests that speak LCM hear nobody and are heard by nobody.
/// Returns "" or why not.
inline const std::string& private_network() {
    static const std::string problem = enter_private_network();
    return problem;
}

}  // namespace goalmouth::test

/// First line of a test that speaks LCM: enters the private network, or skips the test and says why.
#define GOALMOUTH_NEEDS_PRIVATE_NETWORK()                                                                  \
    if (const std::string& network_problem = goalmouth::test::private_network(); !network_problem.empty()) \
    GTEST_SKIP() << "skipped: no private network: " << network_problem
