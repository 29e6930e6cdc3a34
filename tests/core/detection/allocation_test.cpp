#include "core/detection/ransac_detector.h"
#include "core/extraction/border.h"
#include "core/extraction/extraction.h"
#include "core/segmentation/segmentation.h"
#include "tests/support/allocations.h"
#include "tests/support/post_scene.h"

#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

/// Noise of the post's and the field's colour over a scene: many short runs, many edge points.
YuyvImage noisy(const test::PostScene& scene, Random& random) {
    YuyvImage image = test::scene_image(scene);
    for (int speck = 0; speck < 400; ++speck) {
        const auto x = static_cast<int>(random.index(static_cast<std::uint32_t>(scene.width / 2 - 4)));
        const auto y = static_cast<int>(random.index(static_cast<std::uint32_t>(scene.height - 4)));
        const Ycbcr colour = random.index(2) ? Ycbcr{170, 50, 150} : Ycbcr{90, 100, 90};
        for (int dy = 0; dy < 4; ++dy) {
            for (int dx = 0; dx < 4; ++dx) {
                std::uint8_t* pair = image.data.data() + (y + dy) * image.stride() + 4 * (x + dx);
                pair[0] = pair[2] = colour.y;
                pair[1] = colour.cb;
                pair[3] = colour.cr;
            }
        }
    }
    return image;
}

TEST(Allocations, ThereAreNoneBetweenSegmentsAndPostsOnceWarm) {
    if (!test::allocations_are_counted()) GTEST_SKIP() << "another heap than the C library's";
    const ColourTable table = test::scene_table();
    const ScanLayout layout = image_layout(640, 480, {});
    Random random(1);
    std::vector<Segments> frames;
    for (int i = 0; i < 12; ++i) {
        test::PostScene scene{640, 480, 200, 60 + 40 * i, 75 + 44 * i, 40 + 5 * i, 300};
        if (i == 11) scene.post_left = 0, scene.post_right = 639;
        frames.push_back(segment_frame(noisy(scene, random).view(), table, layout));
    }

    Intrinsics camera;
    camera.width = 640;
    camera.height = 480;
    RansacDetectorParameters parameters;
    parameters.pairing.largest_hole = 0.3;
    BorderFinder border({});
    CandidateExtractor extractor({});
    RansacDetector detector(parameters, 0.1);
    std::size_t edges = 0;
    std::size_t posts = 0;
    const auto run = [&] {
        for (const Segments& frame : frames) {
            const Candidates& candidates = extractor.extract(frame, border.find(frame));
            edges += candidates.left_edges.size();
            posts += detector.detect(candidates, camera, random).size();
        }
    };
    run();
    run();
    const test::AllocationCount count;
    run();
    EXPECT_EQ(count.so_far(), 0U);
    EXPECT_GT(edges, 500U);
    EXPECT_GT(posts, 20U);
}

}  // namespace
}  // namespace goalmouth
