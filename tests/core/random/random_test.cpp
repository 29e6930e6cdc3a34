#include "core/random/random.h"

#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(Random, IsTheSameForTheSameSeed) {
    Random a(42);
    Random b(42);
    for (int i = 0; i < 1000; ++i) ASSERT_EQ(a.bits(), b.bits());
}

TEST(Random, DrawsWhatItAlwaysDrew) {
    // Old logs replay only while these stand.
    Random random(1);
    EXPECT_EQ(random.bits(), 0xcfc5d07f6f03c29bULL);
    EXPECT_EQ(random.bits(), 0xbf424132963fe08dULL);
}

TEST(Random, SeedZeroIsAsGoodAsAny) {
    Random random(0);
    std::set<std::uint64_t> seen;
    for (int i = 0; i < 1000; ++i) seen.insert(random.bits());
    EXPECT_EQ(seen.size(), 1000U);
}

TEST(Random, UniformFillsItsInterval) {
    Random random(3);
    double sum = 0.0;
    double squares = 0.0;
    constexpr int n = 200000;
    for (int i = 0; i < n; ++i) {
        const double u = random.uniform(-2.0, 4.0);
        ASSERT_GE(u, -2.0);
        ASSERT_LT(u, 4.0);
        sum += u;
        squares += (u - 1.0) * (u - 1.0);
    }
    EXPECT_NEAR(sum / n, 1.0, 0.02);
    EXPECT_NEAR(squares / n, 3.0, 0.03);  // 6² / 12
}

TEST(Random, IndexHitsEveryValueEquallyOften) {
    Random random(4);
    std::array<int, 7> counts{};
    constexpr int n = 70000;
    for (int i = 0; i < n; ++i) ++counts.at(random.index(7));
    for (const int c : counts) EXPECT_NEAR(c, n / 7, 5 * std::sqrt(n / 7.0));
    for (int i = 0; i < 10; ++i) EXPECT_EQ(random.index(1), 0U);
}

TEST(Random, NormalHasItsMoments) {
    Random random(5);
    double m1 = 0.0, m2 = 0.0, m3 = 0.0, m4 = 0.0;
    constexpr int n = 400000;
    for (int i = 0; i < n; ++i) {
        const double x = random.normal();
        ASSERT_TRUE(std::isfinite(x));
        m1 += x;
        m2 += x * x;
        m3 += x * x * x;
        m4 += x * x * x * x;
    }
    EXPECT_NEAR(m1 / n, 0.0, 0.01);
    EXPECT_NEAR(m2 / n, 1.0, 0.01);
    EXPECT_NEAR(m3 / n, 0.0, 0.03);
    EXPECT_NEAR(m4 / n, 3.0, 0.08);
}

TEST(RandomForFrame, DependsOnSeedModuleAndFrame) {
    const auto first = [](std::uint64_t seed, const char* module, std::int64_t seq) {
        return random_for_frame(seed, module, seq).bits();
    };
    EXPECT_EQ(first(1, "detection", 7), first(1, "detection", 7));
    EXPECT_NE(first(1, "detection", 7), first(2, "detection", 7));
    EXPECT_NE(first(1, "detection", 7), first(1, "localisation", 7));
    EXPECT_NE(first(1, "detection", 7), first(1, "detection", 8));
    std::set<std::uint64_t> seen;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
        for (std::int64_t seq = -1; seq < 500; ++seq) seen.insert(first(seed, "simulator", seq));
    EXPECT_EQ(seen.size(), 20U * 501U);
}

}  // namespace
}  // namespace goalmouth
