#include "core/refinement/edge_consensus.h"
#include "core/refinement/post_refiner.h"
#include "core/refinement/row_gate.h"
#include "tests/core/refinement/drawn_post.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth::test {
namespace {

const Levels grey{150, 150, 155};

/// A small picture where the post lies, to draw quickly. A pixel of width is 19 cm of distance here.
DrawnPost cluttered() {
    DrawnPost scene;
    scene.camera.width = 160;
    scene.camera.height = 240;
    scene.camera.cx = 79.5;
    scene.camera.cy = 119.5;
    scene.distance = 3.2;
    return scene;
}

RefinedPost refine(const DrawnPost& scene, const YuyvImage& image) {
    PostRefiner refiner({}, {});
    return refiner.refine(image.view(), {scene.found(0.5, -0.4)}, scene.camera, scene.pose()).front();
}

void expect_measured(const RefinedPost& refined, const DrawnPost& scene, double near) {
    ASSERT_TRUE(refined.post.has(post_flag::refined)) << refined.reason << refined.quality;
    EXPECT_NEAR(refined.post.distance_m, scene.distance, near);
}

TEST(Clutter, BlackThingThatPeepsOutBesideThePostIsNotThePost) {
    for (const double out : {0.8, 1.2, 2.0}) {
        DrawnPost scene = cluttered();
        const PostEdges edges{scene.found()};
        scene.behind = [&](double x, double y) {
            const bool board = y < edges.row(0.6) && x > edges.left(y) - out && x < edges.right(y) - 3.0;
            return board ? Levels(14, 14, 16) : grey;
        };
        const RefinedPost refined = refine(scene, scene.draw());
        // Less than a pixel of black might be shading: such a post may be given up.
        if (out > 1.0 || refined.post.has(post_flag::refined)) expect_measured(refined, scene, 0.03);
    }
}

TEST(Clutter, StraightSideOfWhatStandsBeforeThePostIsNotThePosts) {
    // It hides the right part of the lower rows, to a detector that has taken its side for the post's: in the
    // upper rows the post's colour goes on beyond.
    DrawnPost scene = cluttered();
    const PostEdges edges{scene.found()};
    const double hidden = 0.4 * (edges.right(edges.row(0.5)) - edges.left(edges.row(0.5)));
    scene.before = [&](double x, double y) -> std::optional<Levels> {
        if (y > edges.row(0.65) && x > edges.right(y) - hidden && x < edges.right(y) + 20.0)
            return Levels(40, 30, 90);
        return std::nullopt;
    };
    PostRefiner refiner({}, {});
    const YuyvImage image = scene.draw();
    expect_measured(
        refiner.refine(image.view(), {scene.found(0.0, -hidden)}, scene.camera, scene.pose()).front(), scene,
        0.03);
}

TEST(Clutter, ThirdColourBetweenPostAndBackgroundTakesRowsAndNotTheFit) {
    for (const double out : {1.2, 2.0}) {
        DrawnPost scene = cluttered();
        const PostEdges edges{scene.found()};
        scene.behind = [&](double x, double y) {
            const bool board = y < edges.row(0.55) && x < edges.right(y) + out && x > edges.left(y) + 3.0;
            return board ? Levels(200, 20, 120) : grey;
        };
        expect_measured(refine(scene, scene.draw()), scene, 0.03);
    }
}

TEST(Clutter, RowsBeforeSeveralBackgroundsOutweighMoreRowsBehindOneOccluder) {
    DrawnPost scene = cluttered();
    const PostEdges edges{scene.found()};
    scene.behind = [&](double, double y) {
        const double share = (y - edges.row(0.0)) / (edges.row(1.0) - edges.row(0.0));
        if (share < 0.15) return grey;
        if (share < 0.28) return Levels(40, 60, 160);
        return share < 0.4 ? Levels(90, 150, 90) : grey;
    };
    scene.before = [&](double x, double y) {
        const bool hides = y > edges.row(0.45) && x < edges.left(y) + 0.6;
        return hides ? std::optional<Levels>(Levels(120, 125, 140)) : std::nullopt;
    };
    expect_measured(refine(scene, scene.draw()), scene, 0.03);
}

struct PlainRow {
    double offset;
    float background;
};

/// Rows as of an upright post, measured.
EdgeRows rows_of(const std::vector<PlainRow>& plain, double side) {
    EdgeRows rows;
    rows.assign(plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) {
        rows.pairs[i] = 8.0F;
        rows.measured.information[i] = 100.0F;
        rows.measured.offset[i] = static_cast<float>(plain[i].offset);
        rows.background[0][i] = plain[i].background;
        rows.clean[i] = 1.0F;
        rows.turn[i] =
            static_cast<float>(side * (static_cast<double>(i) - 0.5 * static_cast<double>(plain.size())));
    }
    return rows;
}

using PlainRows = std::vector<PlainRow>;

TEST(EdgeConsensus, ThreeRunsThatAgreeOutweighALongerOne) {
    PlainRows left(60, {-0.8, 0.0F});
    for (int i = 0; i < 36; ++i) left.push_back({0.02, i < 12 ? 60.0F : i < 24 ? 120.0F : 180.0F});
    std::array<EdgeRows, 2> rows = {rows_of(left, -1.0), rows_of(PlainRows(96, {0.0, 0.0F}), 1.0)};
    EdgeConsensus consensus;
    const EdgeConsensus::Result result = consensus.find(rows, 0.0, 0.02);
    EXPECT_TRUE(result.disagree);
    EXPECT_GT(result.evidence[0], result.rival[0] + 3.0);
    for (std::size_t i = 0; i < 96; ++i) {
        EXPECT_EQ(rows[0].outvoted[i], i < 60 ? 1.0F : 0.0F) << i;
        EXPECT_EQ(rows[1].outvoted[i], 0.0F) << i;
    }
}

TEST(EdgeConsensus, TwoRunsThatDisagreeLeaveItOpen) {
    PlainRows left(48, {0.0, 0.0F});
    left.resize(96, {0.9, 90.0F});
    std::array<EdgeRows, 2> rows = {rows_of(left, -1.0), rows_of(PlainRows(96, {0.0, 0.0F}), 1.0)};
    EdgeConsensus consensus;
    const EdgeConsensus::Result result = consensus.find(rows, 0.0, 0.02);
    EXPECT_TRUE(result.disagree);
    EXPECT_LT(result.evidence[0] - result.rival[0], 2.0);
}

TEST(EdgeConsensus, RowsThatAgreeAreLeftAlone) {
    PlainRows plain;
    for (int i = 0; i < 96; ++i) plain.push_back({0.05 * std::sin(1.7 * i), i < 40 ? 0.0F : 80.0F});
    std::array<EdgeRows, 2> rows = {rows_of(plain, -1.0), rows_of(plain, 1.0)};
    EdgeConsensus consensus;
    EXPECT_FALSE(consensus.find(rows, 0.0, 0.02).disagree);
    for (const EdgeRows& side : rows)
        for (std::size_t i = 0; i < side.count; ++i) EXPECT_EQ(side.outvoted[i], 0.0F);
}

TEST(RowGate, MisfitOfBothEdgesIsTheCamerasOfOneTheBackgrounds) {
    StepProfile profile;
    profile.set_blur(0.9, 0.5);
    for (const bool both : {true, false}) {
        std::array<EdgeRows, 2> rows;
        for (std::size_t side = 0; side < 2; ++side) {
            rows[side] = rows_of(PlainRows(90, {0.0, 0.0F}), 0.0);
            for (std::size_t i = 0; i < 90; ++i) {
                rows[side].measured.freedom[i] = 4.0F;
                rows[side].measured.misfit[i] = both || side == 0 ? 12.0F : 0.6F;
            }
        }
        std::array<double, 2> noise = {1.0, 1.0};
        RowGate gate;
        gate.weigh(rows, noise, profile, true);
        if (both)
            EXPECT_GT(rows[0].weight[45], 0.9F);
        else
            EXPECT_EQ(rows[0].weight[45], 0.0F);
        EXPECT_GT(rows[1].weight[45], 0.9F);
    }
}

/// As webcams sharpen: half of what differs from the neighbours' mean is added.
void sharpen(YuyvImage& image) {
    const YuyvImage before = image;
    for (int y = 0; y < image.height; ++y) {
        const std::uint8_t* in = before.data.data() + static_cast<std::ptrdiff_t>(y) * before.stride();
        std::uint8_t* out = image.data.data() + static_cast<std::ptrdiff_t>(y) * image.stride();
        const auto mend = [&](int at, int step) {
            const double mean = (in[at - step] + in[at] + in[at + step]) / 3.0;
            out[at] =
                static_cast<std::uint8_t>(std::clamp(std::lround(in[at] + 0.5 * (in[at] - mean)), 0L, 255L));
        };
        for (int x = 4; x + 4 < image.stride(); ++x) mend(x, x % 2 == 0 ? 2 : 4);
    }
}

TEST(Clutter, SharpenedPictureIsNoClutter) {
    DrawnPost scene = cluttered();
    scene.noise = 1.5;
    YuyvImage image = scene.draw();
    sharpen(image);
    const RefinedPost refined = refine(scene, image);
    expect_measured(refined, scene, 0.05);
    EXPECT_GT(refined.left->rows, refined.rows / 2);
}

TEST(Clutter, RowsOutvotedOnceCountAgainInTheNextPicture) {
    DrawnPost hidden = cluttered();
    const PostEdges edges{hidden.found()};
    hidden.before = [&](double x, double y) {
        const bool hides = y > edges.row(0.55) && x < edges.left(y) + 1.5;
        return hides ? std::optional<Levels>(Levels(40, 40, 46)) : std::nullopt;
    };
    const DrawnPost scene = cluttered();
    const YuyvImage first = hidden.draw(), second = scene.draw();
    PostRefiner used({}, {}), fresh({}, {});
    used.refine(first.view(), {hidden.found()}, hidden.camera, hidden.pose());
    const RefinedPost again = used.refine(second.view(), {scene.found()}, scene.camera, scene.pose()).front();
    const RefinedPost expected =
        fresh.refine(second.view(), {scene.found()}, scene.camera, scene.pose()).front();
    EXPECT_EQ(again.left->rows, expected.left->rows);
    EXPECT_EQ(again.post.distance_m, expected.post.distance_m);
    EXPECT_EQ(again.post.covariance, expected.post.covariance);
}

TEST(Clutter, PixelsBeyondTheBorderThatCutsAPostDoNotMatter) {
    const DrawnPost scene = cluttered();
    const YuyvImage drawn = scene.draw();
    const Post found = scene.found();
    for (const bool cut_left : {true, false}) {
        for (int shown = 2; shown <= 14; shown += 2) {  // px of it
            const int even =
                2 * static_cast<int>((cut_left ? found.right_top.x() : found.left_top.x()) / 2.0);
            const int first = cut_left ? even - shown : 20;
            const int width = cut_left ? 60 : even + shown - first;
            YuyvImage other = drawn;
            for (int y = 0; y < other.height; ++y) {
                std::uint8_t* row = other.data.data() + static_cast<std::ptrdiff_t>(y) * other.stride();
                std::fill(row, row + 2 * first, std::uint8_t{250});
                std::fill(row + 2 * (first + width), row + other.stride(), std::uint8_t{3});
            }
            Intrinsics camera = scene.camera;
            camera.width = width;
            camera.cx -= first;
            Post post = found;
            for (auto* corner : {&post.left_top, &post.left_base, &post.right_top, &post.right_base})
                corner->x() -= first;
            const auto measured = [&](const YuyvImage& image) {
                PostRefiner refiner({}, {});
                const YuyvView part{image.data.data() + 2 * first, width, image.height, image.stride()};
                return refiner.refine(part, {post}, camera, scene.pose()).front();
            };
            const RefinedPost a = measured(drawn), b = measured(other);
            EXPECT_EQ(a.reason, b.reason) << cut_left << shown;
            EXPECT_EQ(a.quality, b.quality) << cut_left << shown;
            EXPECT_EQ(a.post.bearing_rad, b.post.bearing_rad) << cut_left << shown;
        }
    }
}

}  // namespace
}  // namespace goalmouth::test
