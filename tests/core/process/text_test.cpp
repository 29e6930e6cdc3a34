#include "core/process/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(Text, SplitsAtTheSeparator) {
    EXPECT_EQ(split("a.b.c", '.'), (std::vector<std::string>{"a", "b", "c"}));
    EXPECT_EQ(split("alone", '.'), (std::vector<std::string>{"alone"}));
    EXPECT_EQ(split("", '.'), (std::vector<std::string>{""}));
}

TEST(Text, SuggestsWhatIsClose) {
    EXPECT_EQ(suggestion("atempts", {"attempts", "spacing"}),
              "did you mean 'attempts'? valid: attempts, spacing");
}

TEST(Text, SuggestsNothingFarFetched) {
    EXPECT_EQ(suggestion("zebra", {"attempts", "spacing"}), "valid: attempts, spacing");
    EXPECT_EQ(suggestion("zebra", {}), "nothing is valid here");
}

}  // namespace
}  // namespace goalmouth
