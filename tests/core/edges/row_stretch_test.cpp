#include "core/edges/row_stretch.h"

#include "tests/support/vector_targets.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::on_each_vector_target;

TEST(RowStretch, TellsHowUnlikeASurfaceEachBoxLooks) {
    YuyvImage image(203, 2);
    std::mt19937 random(11);
    for (std::uint8_t& byte : image.data) byte = static_cast<std::uint8_t>(random() & 255U);
    for (const Appearance& surface : {Appearance{120.F, -30.F, 12.F}, Appearance{}}) {
        std::vector<float> first;
        on_each_vector_target([&] {
            RowStretch stretch;
            stretch.load(image.view(), 1, 40, 400);
            EXPECT_EQ(stretch.first(), 40);
            EXPECT_EQ(stretch.end(), 102) << "what the row has of it";
            const auto unlike = stretch.unlikeness(45, 97, 5, surface, 2.F);
            ASSERT_EQ(unlike.size(), 53U);
            for (int i = 45; i <= 97; ++i) {
                const float plain = squared_unlikeness(stretch.mean(i, i + 4), surface, 2.F);
                EXPECT_NEAR(unlike[static_cast<std::size_t>(i - 45)], std::sqrt(plain), 1e-3F) << i;
            }
            if (first.empty()) first.assign(unlike.begin(), unlike.end());
            EXPECT_TRUE(std::equal(unlike.begin(), unlike.end(), first.begin()));
        });
    }
}

/// A row of `a` up to `edge`, of `b` from there on, the pixel between them mixed.
YuyvImage step_row(int width, double edge, Ycbcr a, Ycbcr b) {
    YuyvImage image(width, 1);
    const auto share = [&](int x) { return std::min(std::max(x + 0.5 - edge, 0.0), 1.0); };
    const auto mixed = [](double from, double to, double s) {
        return static_cast<std::uint8_t>(std::lround(from + s * (to - from)));
    };
    for (int x = 0; x < 2 * ((width + 1) / 2); x += 2) {
        std::uint8_t* pair = image.data.data() + 2 * x;
        pair[0] = mixed(a.y, b.y, share(x));
        pair[1] = mixed(a.cb, b.cb, 0.5 * (share(x) + share(x + 1)));
        pair[2] = mixed(a.y, b.y, share(x + 1));
        pair[3] = mixed(a.cr, b.cr, 0.5 * (share(x) + share(x + 1)));
    }
    return image;
}

TEST(RowStretch, PlacesAStepToAFractionOfAPixel) {
    const Ycbcr a{200, 110, 140};
    const Ycbcr b{40, 130, 118};
    for (const double edge : {20.0, 20.3, 21.6, 31.5}) {
        const YuyvImage image = step_row(33, edge, a, b);
        double first = 0.0;
        on_each_vector_target([&] {
            RowStretch stretch;
            stretch.load(image.view(), 0, 5, 17);
            const double place =
                stretch.step_place(static_cast<int>(edge / 2.0), 5, {200.F, -18.F, 12.F}, {40.F, 2.F, -10.F});
            EXPECT_NEAR(place, edge, 0.06) << "also by the row's end, which is of odd width";
            if (first == 0.0) first = place;
            EXPECT_EQ(place, first);
        });
    }
}

}  // namespace
}  // namespace goalmouth
