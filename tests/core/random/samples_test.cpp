#include "core/random/samples.h"

#include "core/random/random.h"
#include "tests/support/vector_targets.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(Samples, ComeFromSplitMix64) {
    // Old logs replay only while these stand.
    constexpr std::uint64_t expected[] = {6457827717110365317U, 3203168211198807973U, 9817491932198370423U,
                                          4593380528125082431U, 16408922859458223821U};
    for (std::uint64_t i = 0; i < 5; ++i) EXPECT_EQ(keyed_bits(1234567, i), expected[i]);
}

TEST(Samples, DrawnTogetherAreThoseDrawnOneByOne) {
    test::on_each_vector_target([] {
        for (const std::uint32_t count : {2U, 3U, 50U, 1000U, 70000U, 3000000000U, 4294967295U}) {
            for (const std::size_t pairs : {0U, 1U, 3U, 50U, 64U, 65U, 200U}) {
                for (const std::uint64_t place :
                     {std::uint64_t{0}, std::uint64_t{64}, std::uint64_t{1} << 40}) {
                    const std::uint64_t key = Random(count + pairs).bits();
                    std::vector<std::uint64_t> drawn(pairs + 8);
                    draw_pairs(key, place, count, pairs, drawn.data());
                    for (std::size_t i = 0; i < pairs; ++i) {
                        const auto [first, second] = draw_sample<2>(key, place + i, count);
                        ASSERT_EQ(drawn[i] & 0xFFFFFFFFU, first) << count;
                        ASSERT_EQ(drawn[i] >> 32, second) << count;
                    }
                }
            }
        }
    });
}

/// Draws of each key that all samples of so many numbers are equally often among.
template <std::size_t size>
void expect_all_equally_often(std::uint32_t count, std::size_t samples) {
    constexpr int each = 2000;
    std::map<std::array<std::uint32_t, size>, int> often;
    for (std::size_t i = 0; i < each * samples; ++i) {
        const auto sample = draw_sample<size>(i % 7, i / 7, count);
        for (std::size_t j = 0; j < size; ++j) {
            ASSERT_LT(sample[j], count);
            for (std::size_t k = 0; k < j; ++k) ASSERT_NE(sample[j], sample[k]);
        }
        ++often[sample];
    }
    ASSERT_EQ(often.size(), samples);
    double squares = 0.0;
    for (const auto& [sample, times] : often) squares += std::pow(times - each, 2) / each;
    // χ² of samples − 1 degrees of freedom, to five sigma on either side.
    const double freedom = static_cast<double>(samples) - 1.0;
    EXPECT_NEAR(squares, freedom, 5.0 * std::sqrt(2.0 * freedom));
}

TEST(Samples, AreAllEquallyOften) {
    expect_all_equally_often<1>(9, 9);
    expect_all_equally_often<2>(7, 7 * 6);
    expect_all_equally_often<3>(5, 5 * 4 * 3);
    expect_all_equally_often<4>(6, 6 * 5 * 4 * 3);
    expect_all_equally_often<2>(2, 2);
    expect_all_equally_often<3>(3, 6);
}

TEST(Samples, OfTheNextPlaceOrKeyTellNothingOfEachOther) {
    constexpr std::uint32_t count = 8;
    constexpr int each = 1000;
    const auto expect_independent = [](std::uint64_t key_step, std::uint64_t place_step) {
        std::map<std::array<std::uint32_t, 4>, int> often;
        constexpr std::size_t ways = count * (count - 1) * count * (count - 1);
        for (std::uint64_t i = 0; i < each * ways; ++i) {
            // Of no key or place twice.
            const std::uint64_t key = 2 * i * key_step;
            const std::uint64_t place = 2 * i * place_step;
            const auto a = draw_sample<2>(key, place, count);
            const auto b = draw_sample<2>(key + key_step, place + place_step, count);
            ++often[{a[0], a[1], b[0], b[1]}];
        }
        ASSERT_EQ(often.size(), ways);
        double squares = 0.0;
        for (const auto& [samples, times] : often) squares += std::pow(times - each, 2) / each;
        const double freedom = static_cast<double>(ways) - 1.0;
        EXPECT_NEAR(squares, freedom, 5.0 * std::sqrt(2.0 * freedom));
    };
    expect_independent(0, 1);
    expect_independent(1, 0);
}

}  // namespace
}  // namespace goalmouth
