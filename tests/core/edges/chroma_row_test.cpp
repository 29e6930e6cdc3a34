#include "core/edges/chroma_row.h"

#include "tests/support/vector_targets.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using test::on_each_vector_target;
using testing::ElementsAre;

YuyvImage noise_row(int width, unsigned seed) {
    std::mt19937 random(seed);
    YuyvImage image(width, 1);
    for (std::uint8_t& byte : image.data) byte = static_cast<std::uint8_t>(random() & 255U);
    return image;
}

/// By the definition in the header.
std::vector<double> plain_steps(const ChromaRow& row, int window, double weight) {
    std::vector<double> steps(static_cast<std::size_t>(row.pairs()), 0.0);
    for (int i = window; i + window <= row.pairs(); ++i) {
        double d[3] = {};
        for (int k = 0; k < window; ++k) {
            const Appearance a = row.at(i + k);
            const Appearance b = row.at(i - 1 - k);
            d[0] += static_cast<double>(a.y - b.y) / window;
            d[1] += static_cast<double>(a.cb - b.cb) / window;
            d[2] += static_cast<double>(a.cr - b.cr) / window;
        }
        steps[static_cast<std::size_t>(i)] = d[0] * d[0] + weight * (d[1] * d[1] + d[2] * d[2]);
    }
    return steps;
}

TEST(ChromaRow, DerivesAsDefinedOnEveryMachine) {
    for (const int width : {1, 6, 13, 64, 333, 1280}) {
        const YuyvImage image = noise_row(width, static_cast<unsigned>(width));
        for (const int window : {1, 2, 5}) {
            std::vector<float> first;
            on_each_vector_target([&] {
                ChromaRow row;
                row.load(image.view(), 0);
                const auto steps = row.squared_steps(window, 2.F);
                const auto plain = plain_steps(row, window, 2.0);
                ASSERT_EQ(steps.size(), plain.size());
                for (std::size_t i = 0; i < plain.size(); ++i)
                    EXPECT_NEAR(static_cast<double>(steps[i]), plain[i], 1e-4 * (1.0 + plain[i])) << i;
                if (first.empty()) first.assign(steps.begin(), steps.end());
                EXPECT_TRUE(std::equal(steps.begin(), steps.end(), first.begin()));
            });
        }
    }
}

TEST(ChromaRow, FindsThePeakOfAStepInColourAlone) {
    YuyvImage image(64, 1);
    for (int pair = 0; pair < 32; ++pair) {
        image.data[static_cast<std::size_t>(4 * pair)] = 100;
        image.data[static_cast<std::size_t>(4 * pair + 1)] = pair < 20 ? 128 : 90;
        image.data[static_cast<std::size_t>(4 * pair + 2)] = 100;
        image.data[static_cast<std::size_t>(4 * pair + 3)] = pair < 9 ? 100 : 128;
    }
    on_each_vector_target([&] {
        ChromaRow row;
        row.load(image.view(), 0);
        row.squared_steps(2, 2.F);
        EXPECT_THAT(row.peaks(100.F, 2), ElementsAre(9, 20));
        EXPECT_THAT(row.peaks(2000.F, 2), ElementsAre(20));
        row.squared_steps(2, 0.F);
        EXPECT_TRUE(row.peaks(1.F, 2).empty());
    });
}

TEST(ChromaRow, FindsPeaksAsDefined) {
    const YuyvImage image = noise_row(1001, 5);
    on_each_vector_target([&] {
        ChromaRow row;
        row.load(image.view(), 0);
        const auto found = row.squared_steps(2, 1.F);
        const std::vector<float> steps(found.begin(), found.end());
        for (const int reach : {1, 3, 7}) {
            std::vector<std::int32_t> plain;
            for (int i = 0; i < row.pairs(); ++i) {
                const auto at = [&](int k) {
                    return k < 0 || k >= row.pairs() ? 0.F : steps[static_cast<std::size_t>(k)];
                };
                bool peak = at(i) >= 900.F;
                for (int k = 1; k <= reach; ++k) peak = peak && at(i) >= at(i - k) && at(i) > at(i + k);
                if (peak) plain.push_back(i);
            }
            const auto peaks = row.peaks(900.F, reach);
            EXPECT_TRUE(std::equal(peaks.begin(), peaks.end(), plain.begin(), plain.end())) << reach;
        }
    });
}

TEST(ChromaRow, KnowsTheFieldAsItsColourDoes) {
    std::vector<FieldSample> samples;
    std::mt19937 random(3);
    for (int i = 0; i < 500; ++i) {
        const float light = 0.5F + static_cast<float>(random() % 100) / 100.F;
        samples.push_back({Appearance{90.F, -14.F, -32.F} * light, 1.F});
    }
    const auto field = FieldColourFinder().find(samples, 0.1F);
    ASSERT_TRUE(field);
    YuyvImage image = noise_row(999, 8);
    for (std::size_t i = 0; i < image.data.size(); i += 8) {  // every other pair near the field
        image.data[i] = image.data[i + 2] = static_cast<std::uint8_t>(60 + random() % 90);
        image.data[i + 1] = static_cast<std::uint8_t>(105 + random() % 15);
        image.data[i + 3] = static_cast<std::uint8_t>(90 + random() % 15);
        if (i + 16 < image.data.size())
            std::copy_n(image.data.begin() + static_cast<std::ptrdiff_t>(i), 4,
                        image.data.begin() + static_cast<std::ptrdiff_t>(i) + 4);
    }
    on_each_vector_target([&] {
        ChromaRow row;
        row.load(image.view(), 0);
        const auto is_field = row.is_field(*field);
        ASSERT_EQ(static_cast<int>(is_field.size()), row.pairs());
        int yes = 0;
        for (int i = 0; i + 1 < row.pairs(); ++i) {
            EXPECT_EQ(is_field[static_cast<std::size_t>(i)] != 0, field->contains(row.mean(i, i + 1))) << i;
            yes += is_field[static_cast<std::size_t>(i)];
        }
        // The last one has no neighbour to the right.
        EXPECT_EQ(is_field.back() != 0, field->contains(row.at(row.pairs() - 1)));
        EXPECT_GT(yes, 20);
        EXPECT_LT(yes, row.pairs() - 20);
    });
}

}  // namespace
}  // namespace goalmouth
