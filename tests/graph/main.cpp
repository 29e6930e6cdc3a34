#include "core/messaging/private_network.h"

#include <iostream>

#include <gtest/gtest.h>

// Every process that a test starts talks in a network that nobody else hears.
int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (!GTEST_FLAG_GET(list_tests)) {
        const std::string problem = goalmouth::enter_private_network();
        if (!problem.empty()) {
            std::cout << "skipped: these tests need a network of their own: " << problem << '\n';
            return 0;
        }
    }
    return RUN_ALL_TESTS();
}
