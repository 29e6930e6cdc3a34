#include "core/conversion/colour_gains.h"

#include "core/messaging/validation.h"

#include <optional>
#include <string>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(ColourGainsConversion, ComeBackAsTheyWere) {
    const ColourGains gains{0.7, 0.6, 0.5};
    const Eigen::Vector3d green(52, 122, 48), yellow(226, 184, 34);
    for (const KnownColours& known : {KnownColours{}, KnownColours{green, std::nullopt},
                                      KnownColours{std::nullopt, yellow}, KnownColours{green, yellow}}) {
        const colour_gains_t message = to_message(gains, known, 1'000'000, 3, 1'300'000);
        EXPECT_FALSE(problem(message)) << problem(message).value_or("");
        EXPECT_EQ(message.utime, 1'000'000);
        EXPECT_EQ(message.seq, 3);
        EXPECT_EQ(message.from_utime, 1'300'000);
        EXPECT_EQ(from_message(message), gains);
        EXPECT_EQ(known_colours(message), known);
    }
}

}  // namespace
}  // namespace goalmouth
