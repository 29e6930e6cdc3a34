// What lcm-spy sees on the tap's port: each channel of the running graph, decoded by the Java types.

#include "core/messaging/tap_url.h"
#include "tests/graph/running_graph.h"
#include "tests/support/processes.h"

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

class JavaTypes : public testing::TestWithParam<const char*> {};

TEST_P(JavaTypes, DecodeEveryChannel) {
    if (!std::filesystem::exists(test::program("java_types"))) {
        GTEST_SKIP() << "skipped: no JDK or lcm.jar when this was built";
    }
    GraphOptions options;
    options.tap = GetParam();
    options.settings = {"camera.frames_per_second=10"};
    test::RunningGraph graph(test::shipped_graph("refined"), options);
    std::vector<std::string> command = {test::program("java_types").string(), "60", "STATUS"};
    for (const auto& process : graph.launcher().graph().processes) {
        for (const auto& use : process.description.info.publishes) {
            const std::string channel = process.channel(use.channel);
            // A picture goes whole where it fits a datagram, in slices where not: raw ones never fit.
            const bool other_form = channel == (options.tap == "raw" ? "IMAGE_TAP" : "IMAGE_SLICES");
            if (!other_form) command.push_back(channel);
        }
    }
    ASSERT_GE(command.size(), 14U);
    ::setenv("LCM_DEFAULT_URL", tap_url(default_lcm_url).c_str(), 1);
    test::Running java(command, test::new_mark());
    ::unsetenv("LCM_DEFAULT_URL");
    int code = -1;
    graph.until([&] { return (code = java.wait(std::chrono::seconds(0))) >= 0; }, std::chrono::seconds(90));
    EXPECT_EQ(code, 0) << java.output() << graph.story();
}

INSTANTIATE_TEST_SUITE_P(Taps, JavaTypes, testing::Values("jpeg", "raw"),
                         [](const auto& tap) { return std::string(tap.param); });

}  // namespace
}  // namespace goalmouth
