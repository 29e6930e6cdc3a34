#include "core/edges/edge_segmentation.h"

#include "core/extraction/extraction.h"
#include "tests/core/edges/edge_scene.h"
#include "tests/support/vector_targets.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

ScanLayout layout_for(const YuyvImage& image, int spacing = 4) {
    ScanLineParameters parameters;
    parameters.row_spacing = spacing;
    parameters.column_spacing = spacing;
    return image_layout(image.width, image.height, parameters);
}

Segments segments_of(const YuyvImage& image, const EdgeSegmentationParameters& parameters = {}) {
    EdgeSegmenter segmenter(parameters);
    return segmenter.segment(image.view(), layout_for(image));
}

/// Errors of goal runs' transitions against a stripe's edges, and how many of its rows have a run.
struct Found {
    int rows = 0;                                // with a goal run on the stripe
    int others = 0;                              // goal runs elsewhere
    double left_mean = 0.0, right_mean = 0.0;    // px
    double left_worst = 0.0, right_worst = 0.0;  // px
};

Found compare(const Segments& segments, const Stripe& stripe) {
    Found found;
    for (const ScanLine& line : segments.lines) {
        if (line.orientation != Orientation::horizontal) continue;
        for (int i = line.first; i < line.first + line.count; ++i) {
            const Segment& s = segments.segments[static_cast<std::size_t>(i)];
            if (s.colour != Colour::goal) continue;
            const double y = line.position;
            const double middle = 0.5 * (stripe.left_at(y) + stripe.right_at(y));
            if (s.start > middle || s.end < middle || y < stripe.top || y > stripe.base) {
                ++found.others;
                continue;
            }
            ++found.rows;
            const double left = static_cast<double>(s.transition) - stripe.left_at(y);
            const double right =
                static_cast<double>(segments.segments[static_cast<std::size_t>(i) + 1].transition) -
                stripe.right_at(y);
            found.left_mean += left;
            found.right_mean += right;
            found.left_worst = std::max(found.left_worst, std::abs(left));
            found.right_worst = std::max(found.right_worst, std::abs(right));
        }
    }
    if (found.rows > 0) {
        found.left_mean /= found.rows;
        found.right_mean /= found.rows;
    }
    return found;
}

int goal_runs(const Segments& segments) {
    return static_cast<int>(std::count_if(segments.segments.begin(), segments.segments.end(),
                                          [](const Segment& s) { return s.colour == Colour::goal; }));
}

/// Rows of the layout on which the stripe shows.
int rows_of(const Stripe& stripe) {
    return static_cast<int>((std::min(stripe.base, 479.0) - std::max(stripe.top, 0.0)) / 4.0);
}

TEST(EdgeSegmenter, FindsAYellowPostWithItsEdgesToAFractionOfAPixel) {
    for (const double left : {300.0, 300.3, 300.75, 301.2}) {
        EdgeScene scene;
        scene.noise = 0.0;
        scene.stripes[0].left = left;
        const Found found = compare(segments_of(scene.draw()), scene.stripes[0]);
        EXPECT_GE(found.rows, rows_of(scene.stripes[0]) - 2) << left;
        EXPECT_EQ(found.others, 0);
        EXPECT_NEAR(found.left_mean, 0.0, 0.15) << left;
        EXPECT_NEAR(found.right_mean, 0.0, 0.15) << left;
    }
}

TEST(EdgeSegmenter, FindsAPostWhateverItsLeanAndWidth) {
    for (const double degrees : {-20.0, -10.0, 10.0, 20.0}) {
        for (const double width : {9.0, 20.0, 60.0}) {
            EdgeScene scene;
            scene.stripes[0].slope = std::tan(degrees * std::numbers::pi / 180.0);
            scene.stripes[0].width = width;
            scene.stripes[0].top = scene.stripes[0].base - 12.0 * width;
            const Found found = compare(segments_of(scene.draw()), scene.stripes[0]);
            EXPECT_GE(found.rows, 0.8 * rows_of(scene.stripes[0])) << degrees << "° " << width;
            EXPECT_EQ(found.others, 0) << degrees << "° " << width;
            EXPECT_NEAR(found.left_mean, 0.0, 0.25) << degrees << "° " << width;
            EXPECT_NEAR(found.right_mean, 0.0, 0.25) << degrees << "° " << width;
        }
    }
}

TEST(EdgeSegmenter, FindsPostsOverATenfoldRangeOfBrightness) {
    for (const Shade& shade : {yellow, white}) {
        for (const double light : {0.15, 0.3, 1.0, 1.5}) {
            EdgeScene scene;
            scene.stripes[0].shade = shade;
            scene.light = [&](double, double) { return light; };
            const Found found = compare(segments_of(scene.draw()), scene.stripes[0]);
            EXPECT_GE(found.rows, 0.8 * rows_of(scene.stripes[0])) << light << " of " << shade.cb;
            EXPECT_EQ(found.others, 0);
        }
    }
}

TEST(EdgeSegmenter, FindsAWhitePostOnItsLineBeforeALightWall) {
    EdgeScene scene;
    scene.wall = [](double, double) { return Shade{160.0, 1.0, 0.0}; };
    scene.stripes[0].shade = white;
    scene.line_top = 214.0;
    scene.line_base = 226.0;
    const Found found = compare(segments_of(scene.draw()), scene.stripes[0]);
    EXPECT_GE(found.rows, 0.8 * rows_of(scene.stripes[0]));
    EXPECT_EQ(found.others, 0);
}

TEST(EdgeSegmenter, FollowsAPostBeforeAWallThatChanges) {
    EdgeScene scene;  // bright, dark, reddish, dark again
    scene.wall = [](double x, double y) {
        return y < 50.0    ? white
               : y < 90.0  ? grey
               : x < 310.0 ? Shade{100.0, -20.0, 40.0}
                           : Shade{30.0, 0.0, 0.0};
    };
    const Found found = compare(segments_of(scene.draw()), scene.stripes[0]);
    EXPECT_GE(found.rows, 0.7 * rows_of(scene.stripes[0]));
    EXPECT_EQ(found.others, 0);
}

TEST(EdgeSegmenter, FindsPostsAndFieldInHalfShadow) {
    for (const Shade& shade : {yellow, white}) {
        EdgeScene scene;
        scene.stripes[0].shade = shade;
        // The shadow's edge runs across the post and on over the field.
        scene.light = [](double x, double y) { return x + 2.0 * y > 520.0 ? 0.4 : 1.0; };
        const Segments segments = segments_of(scene.draw());
        const Found found = compare(segments, scene.stripes[0]);
        EXPECT_GE(found.rows, 0.7 * rows_of(scene.stripes[0])) << shade.cb;
        EXPECT_EQ(found.others, 0);
        const FieldBorder border = find_border(segments, BorderParameters{});
        ASSERT_GE(border.points.size(), 100U);
        for (const Eigen::Vector2d& p : border.points) {
            if (std::abs(p.x() - 310.0) < 20.0) continue;  // the post's own columns
            EXPECT_NEAR(p.y(), scene.border, 4.0) << "column " << p.x();
        }
    }
}

TEST(EdgeSegmenter, FindsAPostWithOneBrightAndOneDarkSide) {
    EdgeScene scene;
    scene.stripes[0].width = 40.0;
    scene.light = [](double x, double) {
        return x > 300.0 && x < 340.0 ? 1.0 - 0.5 * (x - 300.0) / 40.0 : 0.9;
    };
    const Found found = compare(segments_of(scene.draw()), scene.stripes[0]);
    EXPECT_GE(found.rows, 0.7 * rows_of(scene.stripes[0]));
    EXPECT_EQ(found.others, 0);
}

TEST(EdgeSegmenter, SeesAWhitePostUnderAStrongYellowCast) {
    EdgeScene scene;
    scene.stripes[0].shade = white;
    scene.cast = [](Shade s) { return Shade{s.y, s.cb - 0.45 * s.y, s.cr + 0.1 * s.y}; };
    const Found found = compare(segments_of(scene.draw()), scene.stripes[0]);
    EXPECT_GE(found.rows, 0.8 * rows_of(scene.stripes[0]));
    EXPECT_EQ(found.others, 0);
}

TEST(EdgeSegmenter, FindsAPostInANoisyPicture) {
    EdgeScene scene;
    scene.noise = 12.0;
    const YuyvImage image = scene.draw();
    const Found found = compare(segments_of(image), scene.stripes[0]);
    EXPECT_GE(found.rows, rows_of(scene.stripes[0]) / 2);
    EdgeSegmentationParameters as_it_is;
    as_it_is.edges.most_noise = 255.0;
    EXPECT_EQ(goal_runs(segments_of(image, as_it_is)), 0) << "the scene shows what noise does";
}

TEST(EdgeSegmenter, TakesNoLineOnTheFieldForAPost) {
    EdgeScene scene;  // one that runs away from the camera, from the picture's lower end to the border
    scene.stripes = {{.left = 300.0, .width = 24.0, .top = 186.0, .base = 480.0, .shade = white}};
    EXPECT_EQ(goal_runs(segments_of(scene.draw())), 0);
}

TEST(EdgeSegmenter, TakesNothingForAPostThatDoesNotStandOnTheField) {
    EdgeScene scene;
    scene.stripes = {{.base = 140.0}};
    EXPECT_EQ(goal_runs(segments_of(scene.draw())), 0);
}

TEST(EdgeSegmenter, TakesNothingDarkForAPostUnlessToldTo) {
    EdgeScene scene;
    scene.wall = [](double, double) { return white; };
    scene.stripes = {{.shade = {40.0, 0.0, 0.0}}};
    EXPECT_EQ(goal_runs(segments_of(scene.draw())), 0);
    EdgeSegmentationParameters any;
    any.posts.least_brightness = 0.0;
    EXPECT_GT(compare(segments_of(scene.draw(), any), scene.stripes[0]).rows, 20);
}

TEST(EdgeSegmenter, KnowsHowLargeAPostIsWhereTheCamerasPoseIsKnown) {
    const CameraOverGround view{Intrinsics{}, camera_in_body(0.45, 0.0, 0.25), 0.1};
    // A post 2.5 m ahead, from the ground to 0.9 m.
    const auto pixel = [&](double height) {
        return *project(view.camera, view.T_BC.inverse() * Eigen::Vector3d(2.5, 0.0, height));
    };
    const Eigen::Vector3d foot_C = view.T_BC.inverse() * Eigen::Vector3d(2.5, 0.0, 0.0);
    const double width = view.camera.fx * view.diameter / foot_C.z();
    EdgeSegmenter segmenter{EdgeSegmentationParameters{}};
    const auto runs = [&](double times_width, double times_height, const CameraOverGround* known) {
        EdgeScene scene;
        scene.border = pixel(0.0).y() - 30.0;
        const double w = times_width * width;
        scene.stripes = {{.left = pixel(0.0).x() - 0.5 * w,
                          .width = w,
                          .top = pixel(0.9 * times_height).y(),
                          .base = pixel(0.0).y()}};
        const YuyvImage image = scene.draw();
        return goal_runs(segmenter.segment(image.view(), layout_for(image), known));
    };
    EXPECT_GT(runs(1.0, 1.0, &view), 20);
    EXPECT_GT(runs(1.3, 1.0, &view), 20) << "within what a foot's place can say";
    EXPECT_GT(runs(0.4, 0.7, nullptr), 20);
    EXPECT_EQ(runs(0.4, 0.7, &view), 0) << "too narrow";
    EXPECT_GT(runs(0.7, 0.5, nullptr), 10);
    EXPECT_EQ(runs(0.7, 0.5, &view), 0) << "too low";
}

TEST(EdgeSegmenter, FindsBothPostsOfAGoal) {
    EdgeScene scene;
    scene.stripes = {{.left = 150.0}, {.left = 450.0, .width = 17.0, .base = 200.0}};
    const Segments segments = segments_of(scene.draw());
    for (const Stripe& stripe : scene.stripes)
        EXPECT_GE(compare(segments, stripe).rows, 0.8 * rows_of(stripe)) << stripe.left;
}

TEST(EdgeSegmenter, GivesExtractionItsBorderAndItsEdgePoints) {
    EdgeScene scene;
    const Segments segments = segments_of(scene.draw());
    const FieldBorder border = find_border(segments, BorderParameters{});
    ASSERT_FALSE(border.empty());
    EXPECT_NEAR(border.y_at(100.0), scene.border, 1.5);
    EXPECT_NEAR(border.y_at(600.0), scene.border, 1.5);
    const Candidates candidates = extract_candidates(segments, border, CandidateParameters{});
    EXPECT_GE(static_cast<int>(candidates.left_edges.size()), rows_of(scene.stripes[0]) - 3);
    EXPECT_EQ(candidates.left_edges.size(), candidates.right_edges.size());
}

/// What segments.h promises.
void expect_whole_lines(const Segments& segments, const ScanLayout& layout) {
    ASSERT_EQ(segments.lines.size(), layout.rows.size() + layout.columns.size());
    int next = 0;
    for (const ScanLine& line : segments.lines) {
        const int length = line.orientation == Orientation::horizontal ? segments.width : segments.height;
        ASSERT_EQ(line.first, next);
        ASSERT_GE(line.count, 1);
        next += line.count;
        int start = 0;
        for (int i = line.first; i < next; ++i) {
            const Segment& s = segments.segments[static_cast<std::size_t>(i)];
            ASSERT_EQ(s.start, start);
            ASSERT_GE(s.end, s.start);
            if (i > line.first) {
                ASSERT_NE(s.colour, segments.segments[static_cast<std::size_t>(i) - 1].colour);
            }
            ASSERT_LE(std::abs(s.transition - static_cast<float>(s.start) + 0.5F), 1.2701F);
            start = s.end + 1;
        }
        ASSERT_EQ(start, length);
    }
    ASSERT_EQ(next, static_cast<int>(segments.segments.size()));
}

TEST(EdgeSegmenter, BearsSidesThatAreAlikeButForOnePair) {
    // A white post, farther down before a wall as white, with one dark pair between them: beyond that pair
    // there is no step to be located.
    EdgeScene scene;
    scene.noise = 0.0;
    scene.blur = 0.01;
    scene.stripes[0].left = 299.5;  // between two pixels
    scene.stripes[0].shade = {255.0, 0.0, 0.0};
    scene.wall = [](double x, double y) {
        if (x >= 300.0 || y < 120.0) return Shade{140.0, 0.0, 0.0};
        return x >= 298.0 ? Shade{0.0, 0.0, 0.0} : Shade{255.0, 0.0, 0.0};
    };
    const YuyvImage image = scene.draw();
    EdgeSegmenter segmenter{EdgeSegmentationParameters{}};
    expect_whole_lines(segmenter.segment(image.view(), layout_for(image)), layout_for(image));
    int edges = 0;
    for (const JudgedStrip& judged : segmenter.strips()) {
        for (const StripRow& row : judged.strip.rows) {
            for (const auto& edge : {row.left, row.right}) {
                if (!edge) continue;
                ++edges;
                EXPECT_TRUE(std::isfinite(*edge)) << "row " << row.y;
            }
        }
    }
    EXPECT_GT(edges, 20);
}

TEST(EdgeSegmenter, FindsAPostBeforeAChequeredWall) {
    EdgeScene scene;
    scene.stripes[0].width = 24.0;
    scene.wall = [](double x, double y) {
        const bool even = (static_cast<int>(x / 16.0) + static_cast<int>((y + 500.0) / 36.0)) % 2 == 0;
        return even ? Shade{140.0, 2.0, 1.0} : grey;
    };
    const YuyvImage image = scene.draw();
    EdgeSegmenter segmenter{EdgeSegmentationParameters{}};
    const Found found = compare(segmenter.segment(image.view(), layout_for(image)), scene.stripes[0]);
    EXPECT_GE(found.rows, 0.7 * rows_of(scene.stripes[0]));
    EXPECT_LE(segmenter.strips().size(), 128U) << "however many squares there are";
}

TEST(EdgeSegmenter, CoversEveryLineFromEndToEnd) {
    EdgeScene scene;
    scene.noise = 8.0;
    scene.stripes = {{.left = 150.0}, {.left = 2.0, .width = 12.0}, {.left = 620.0, .width = 60.0}};
    const YuyvImage image = scene.draw();
    expect_whole_lines(segments_of(image), layout_for(image));
}

TEST(EdgeSegmenter, HasNothingToSayOfFramesWithoutAField) {
    EdgeSegmenter segmenter{EdgeSegmentationParameters{}};
    for (const Shade& shade : {Shade{0.0, 0.0, 0.0}, Shade{255.0, 0.0, 0.0}, Shade{120.0, 0.0, 0.0},
                               Shade{150.0, -80.0, 15.0}, Shade{90.0, 60.0, -30.0}}) {
        for (const double noise : {0.0, 6.0}) {
            EdgeScene scene;
            scene.field = shade;
            scene.wall = [&](double, double) { return shade; };
            scene.noise = noise;
            const YuyvImage image = scene.draw();
            const Segments& segments = segmenter.segment(image.view(), layout_for(image));
            EXPECT_FALSE(segmenter.field()) << shade.y << ' ' << shade.cb;
            EXPECT_EQ(goal_runs(segments), 0) << shade.y << ' ' << shade.cb;
            expect_whole_lines(segments, layout_for(image));
        }
    }
}

TEST(EdgeSegmenter, TakesFramesOfAnySizeAndLayoutsOfAnyLines) {
    EdgeSegmenter segmenter{EdgeSegmentationParameters{}};
    EXPECT_TRUE(segmenter.segment(YuyvView{}, ScanLayout{}).lines.empty());
    for (const int width : {1, 2, 3, 7, 17, 33, 640}) {
        for (const int height : {1, 2, 5, 48}) {
            EdgeScene scene;
            scene.width = width;
            scene.height = height;
            scene.border = 0.3 * height;
            scene.stripes = {{.left = 0.4 * width, .width = 0.1 * width, .base = 0.6 * height}};
            const YuyvImage image = scene.draw();
            for (const int spacing : {1, 4, 100}) {
                const ScanLayout layout = layout_for(image, spacing);
                expect_whole_lines(segmenter.segment(image.view(), layout), layout);
            }
            ScanLayout outside{{-3, 0, height, height + 9}, {}};
            EXPECT_EQ(segmenter.segment(image.view(), outside).lines.size(), 1U);
            outside = {{}, {-1, 0, width}};
            EXPECT_EQ(segmenter.segment(image.view(), outside).lines.size(), 1U);
        }
    }
}

TEST(EdgeSegmenter, TakesTheExtremesOfItsParameters) {
    EdgeScene scene;
    scene.width = 2600;
    scene.height = 40;
    scene.border = 10.0;
    const YuyvImage image = scene.draw();
    EdgeSegmentationParameters parameters;
    parameters.edges.window = 32.0;
    parameters.edges.chroma_weight = 16.0;
    parameters.posts.straightness = 400.0;
    parameters.posts.least_rows = 3;
    parameters.posts.largest_gap = 1024;
    parameters.posts.largest_lean = 1.5;
    expect_whole_lines(segments_of(image, parameters), layout_for(image));
    parameters.edges.window = 2.0;
    parameters.edges.noise_factor = 0.0;
    expect_whole_lines(segments_of(image, parameters), layout_for(image));
}

TEST(EdgeSegmenter, SaysTheSameOnEveryMachineAndOfEveryFrameAnew) {
    EdgeScene scene;
    scene.noise = 4.0;
    const YuyvImage image = scene.draw();
    EdgeScene other;
    other.stripes[0].left = 100.0;
    const YuyvImage between = other.draw();
    const Segments first = segments_of(image);
    const auto expect_same = [&](const Segments& again) {
        ASSERT_EQ(again.segments.size(), first.segments.size());
        for (std::size_t i = 0; i < first.segments.size(); ++i) {
            EXPECT_EQ(again.segments[i].start, first.segments[i].start);
            EXPECT_EQ(again.segments[i].colour, first.segments[i].colour);
            EXPECT_EQ(again.segments[i].transition, first.segments[i].transition);
        }
    };
    EXPECT_GT(goal_runs(first), 30);
    EdgeSegmenter segmenter{EdgeSegmentationParameters{}};
    on_each_vector_target([&] {
        segmenter.segment(between.view(), layout_for(between));
        expect_same(segmenter.segment(image.view(), layout_for(image)));
    });
}

}  // namespace
}  // namespace goalmouth
