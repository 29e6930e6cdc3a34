#include "core/edges/chroma_row.h"

#include "core/edges/field_colour.h"
#include "core/edges/row_vectors.h"
#include "tests/support/vector_targets.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
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
    std::vector<std::int32_t> pairs;  // from the right to the left, in uneven steps
    for (int i = 498; i >= 0; i -= 1 + i % 3) pairs.push_back(i);
    on_each_vector_target([&] {
        ChromaRow row;
        row.load(image.view(), 0);
        std::vector<std::uint8_t> is_field(pairs.size() + row_margin, 9);
        find_field(image.data.data(), pairs.data(), pairs.size(), *field, is_field.data());
        int yes = 0;
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            EXPECT_EQ(is_field[k], field->contains(row.mean(pairs[k], pairs[k] + 1)) ? 1 : 0) << pairs[k];
            yes += is_field[k];
        }
        EXPECT_GT(yes, 20);
        EXPECT_LT(yes, static_cast<int>(pairs.size()) - 20);
    });
}

TEST(ChromaRow, TakesTheMeanOfAnyStretch) {
    const YuyvImage image = noise_row(1401, 4);
    ChromaRow row;
    row.load(image.view(), 0);
    for (const auto& [first, last] : {std::pair{0, 0}, {3, 4}, {7, 15}, {2, 600}, {690, 900}, {-4, 2}}) {
        double y = 0.0, cb = 0.0, cr = 0.0;
        int n = 0;
        for (int i = std::max(first, 0); i <= std::min(last, row.pairs() - 1); ++i, ++n) {
            y += static_cast<double>(row.at(i).y);
            cb += static_cast<double>(row.at(i).cb);
            cr += static_cast<double>(row.at(i).cr);
        }
        const Appearance mean = row.mean(first, last);
        EXPECT_NEAR(static_cast<double>(mean.y), y / n, 1e-3) << first;
        EXPECT_NEAR(static_cast<double>(mean.cb), cb / n, 1e-3) << first;
        EXPECT_NEAR(static_cast<double>(mean.cr), cr / n, 1e-3) << first;
    }
    EXPECT_EQ(row.mean(5, 4).y, 0.F);
}

TEST(RowVectors, FindWhereTheGroundBeginsInEachColumn) {
    std::mt19937 random(7);
    for (const std::size_t columns : {1U, 15U, 37U}) {
        constexpr std::size_t rows = 41;
        std::vector<std::uint8_t> mask(rows * columns + row_margin, 0);
        for (std::size_t i = 0; i < rows * columns; ++i)  // more of it farther down, and none in some columns
            mask[i] = i % columns % 5 != 4 && random() % rows < i / columns ? 1 : 0;
        on_each_vector_target([&] {
            std::vector<std::uint8_t> found = mask;
            std::vector<std::int32_t> begins(columns + row_margin);
            find_ground(found.data(), rows, columns, begins.data());
            for (std::size_t c = 0; c < columns; ++c) {
                int sum = 0;
                int most = 0;
                std::size_t plain = rows;
                for (std::size_t r = rows; r-- > 0;) {
                    sum += mask[r * columns + c] != 0 ? 2 : -1;
                    if (sum <= most) continue;
                    most = sum;
                    plain = r;
                }
                EXPECT_EQ(begins[c], static_cast<std::int32_t>(plain)) << c;
                for (std::size_t r = 0; r < rows; ++r)
                    EXPECT_EQ(found[r * columns + c], r < plain ? 0 : mask[r * columns + c]) << c << ' ' << r;
            }
        });
    }
}

}  // namespace
}  // namespace goalmouth
