#include "core/refinement/whole_numbers.h"

#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(WholeNumbers, AreThoseOfTheStandardLibrary) {
    for (const double whole : {-1e6, -3.0, -1.0, 0.0, 1.0, 2.0, 1e6}) {
        for (const double rest : {-0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75}) {
            const double x = whole + rest;
            EXPECT_EQ(whole_below(x), static_cast<int>(std::floor(x))) << x;
            EXPECT_EQ(whole_above(x), static_cast<int>(std::ceil(x))) << x;
            EXPECT_EQ(nearest_whole(x), static_cast<int>(std::lround(x))) << x;
        }
    }
    const double just_below = std::nextafter(0.5, 0.0);  // where adding a half first would round up
    EXPECT_EQ(nearest_whole(just_below), 0);
    EXPECT_EQ(nearest_whole(-just_below), 0);
}

}  // namespace
}  // namespace goalmouth
