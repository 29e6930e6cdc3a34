#include "core/edges/strip_seeds.h"

#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

/// What ChainFinder makes of upright edges that run through the same rows.
struct Bars {
    FrameEdges frame;
    std::vector<EdgeChain> chains;  // each may be a left one and a right one

    /// Edges at every x, in so many bands of rows one below the other; `look(band, i)`: of what lies left of
    /// edge i.
    template <class Look>
    Bars(const std::vector<float>& places, int bands, int rows_of_a_band, Look look) {
        for (int band = 0; band < bands; ++band) {
            const std::size_t before = chains.size();
            for (const float x : places) chains.push_back({{}, {static_cast<double>(x), 0.0}});
            for (int k = 0; k < rows_of_a_band; ++k) {
                frame.first.push_back(frame.edges.size());
                const int row = static_cast<int>(frame.rows.size());
                frame.rows.push_back(4 * row);
                for (std::size_t i = 0; i < places.size(); ++i) {
                    RowEdge edge;
                    edge.x = places[i];
                    edge.left = look(band, i);
                    edge.right = look(band, i + 1);
                    chains[before + i].points.push_back({row, frame.edges.size()});
                    frame.edges.push_back(edge);
                }
            }
        }
        frame.first.push_back(frame.edges.size());
    }
};

std::vector<StripSeed> seeds_of(StripSeedFinder& finder, const Bars& bars, int width) {
    return finder.find(bars.frame, bars.chains, bars.chains, 2.F, 2.0, width);
}

TEST(StripSeedFinder, PairsEdgesWithOneSurfaceBetweenThem) {
    // A post with a faint edge on it, and a dark thing farther on.
    const Bars bars({100.F, 112.F, 124.F, 200.F}, 1, 20, [](int, std::size_t i) {
        constexpr float luma[] = {40.F, 150.F, 158.F, 60.F, 20.F};
        return Appearance{luma[i], 0.F, 0.F};
    });
    StripSeedFinder finder{StripParameters{}};
    const auto seeds = seeds_of(finder, bars, 640);
    ASSERT_FALSE(seeds.empty());
    EXPECT_NEAR(seeds[0].left.at(30.0), 100.0, 1e-6);
    EXPECT_NEAR(seeds[0].right.at(30.0), 124.0, 1e-6);
    EXPECT_EQ(seeds[0].rows, 20);
    for (const StripSeed& seed : seeds)
        EXPECT_FALSE(seed.left.at(30.0) < 101.0 && seed.right.at(30.0) > 199.0) << "beyond the post's edge";
}

TEST(StripSeedFinder, LooksAtFewEdgesOfAChequerboard) {
    std::vector<float> places;
    for (int i = 0; i < 60; ++i) places.push_back(static_cast<float>(10 + 20 * i));
    const Bars bars(places, 20, 10, [](int band, std::size_t i) {
        return Appearance{(static_cast<std::size_t>(band) + i) % 2 == 0 ? 200.F : 40.F, 0.F, 0.F};
    });
    StripSeedFinder finder{StripParameters{}};
    const auto seeds = seeds_of(finder, bars, 1280);
    EXPECT_EQ(seeds.size(), 20U * 59U) << "each square, and nothing across two of them";
    for (const StripSeed& seed : seeds) EXPECT_NEAR(seed.right.at(0.0) - seed.left.at(0.0), 20.0, 1e-6);
    EXPECT_LT(finder.looks(), 8 * bars.frame.edges.size()) << "not every chain with every other one";
}

}  // namespace
}  // namespace goalmouth
