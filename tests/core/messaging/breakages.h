#pragma once

#include "core/messaging/validation.h"

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth::test {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr float nan_f = std::numeric_limits<float>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Each breakage of a valid message must be found, and none may be missed because another one hides it.
template <class Message>
void expect_each_refused(const Message& valid, const std::vector<std::function<void(Message&)>>& breakages) {
    ASSERT_EQ(problem(valid), std::nullopt);
    for (std::size_t i = 0; i < breakages.size(); ++i) {
        Message broken = valid;
        breakages[i](broken);
        EXPECT_TRUE(problem(broken).has_value()) << Message::getTypeName() << ", breakage " << i;
    }
}

}  // namespace goalmouth::test
