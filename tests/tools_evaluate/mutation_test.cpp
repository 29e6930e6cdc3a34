#include "tools/evaluate/paper_run.h"
#include "tools/evaluate/paper_setup.h"
#include "tools/evaluate/paper_summary.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

/// A detector whose posts are changed on their way out.
Detector with_posts(const Detector& base, const std::string& name, const std::function<void(Post&)>& change) {
    return {name, [=]() -> DetectPosts {
                const DetectPosts detect = base.make();
                return [=](const DetectorInput& input) {
                    std::vector<Post> posts = detect(input);
                    for (Post& post : posts) change(post);
                    return posts;
                };
            }};
}

/// A detector that is told another focal length.
Detector with_focal_length(const Detector& base, const std::string& name, double factor) {
    return {name, [=]() -> DetectPosts {
                const DetectPosts detect = base.make();
                return [=](DetectorInput input) {
                    input.told.fx *= factor;
                    input.told.fy *= factor;
                    return detect(input);
                };
            }};
}

void shift(Post& post, double pixels) {
    for (Eigen::Vector2d* corner : {&post.left_top, &post.left_base, &post.right_top, &post.right_base})
        corner->x() += pixels;
}

/// The figures that a healthy detector must show on scene flat.
struct Health {
    double detection = 0.0;      // share of frames in which the post in line is detected
    double edge_offset = 0.0;    // px, the larger of left and right edge's mean offset
    double distance_bias = 0.0;  // mean of (estimate − truth) / truth

    bool detects() const { return detection >= 0.95; }
    bool places_edges() const { return edge_offset < 0.25; }
    /// The camera looks past the post by up to φ = 10° to either side, where distance by width is short by
    /// the mean of 1 − cos²: φ²/3 = 1 %. Half of the 2 % that must be seen, to either side of that.
    bool measures() const { return std::abs(distance_bias + 0.01) < 0.01; }
    bool well() const { return detects() && places_edges() && measures(); }
};

Health health_of(const std::vector<FrameRecord>& records, std::size_t detector) {
    std::vector<const DetectorRecord*> all;
    std::vector<double> relative;
    for (const FrameRecord& frame : records) {
        const DetectorRecord& record = frame.detectors[detector];
        all.push_back(&record);
        if (record.in_line.distance_error)
            relative.push_back(*record.in_line.distance_error / evaluation_cell(frame.place.cell).distance());
    }
    const Summary summary = summarise(all);
    Health health;
    health.detection = static_cast<double>(summary.in_line.detected) / summary.in_line.posts;
    if (summary.in_line.edges)
        health.edge_offset =
            std::max(std::abs((*summary.in_line.edges)[0]), std::abs((*summary.in_line.edges)[1]));
    health.distance_bias = error_statistics(relative).value().bias;
    return health;
}

TEST(Mutation, OfTheDetectorShowsInTheFigures) {
    PaperOptions options;
    options.frames_per_cell = 3;
    options.detectors = "ransac";
    const PaperSetup setup = set_up_paper(options);
    const Detector& ransac = setup.detectors[0];
    const std::vector<Detector> detectors = {
        ransac,
        with_posts(ransac, "swapped edges",
                   [](Post& post) {
                       std::swap(post.left_top, post.right_top);
                       std::swap(post.left_base, post.right_base);
                   }),
        with_posts(ransac, "one pixel right", [](Post& post) { shift(post, 1.0); }),
        with_posts(ransac, "one pixel left", [](Post& post) { shift(post, -1.0); }),
        with_focal_length(ransac, "focal length 2 % long", 1.02),
        with_focal_length(ransac, "focal length 2 % short", 0.98),
    };
    PaperWork work;
    work.jobs = 2;
    const std::vector<FrameRecord> records = run_paper(setup.grid, detectors, work);
    std::vector<Health> health;
    for (std::size_t i = 0; i < detectors.size(); ++i) {
        health.push_back(health_of(records, i));
        SCOPED_TRACE(detectors[i].name);
        RecordProperty(detectors[i].name, std::to_string(health[i].detection) + " " +
                                              std::to_string(health[i].edge_offset) + " " +
                                              std::to_string(health[i].distance_bias));
        EXPECT_EQ(health[i].well(), i == 0)
            << "detection " << health[i].detection << ", edges off by " << health[i].edge_offset
            << " px, distance by " << health[i].distance_bias;
    }
    EXPECT_FALSE(health[1].detects());
    EXPECT_FALSE(health[2].places_edges());
    EXPECT_FALSE(health[3].places_edges());
    EXPECT_FALSE(health[4].measures());
    EXPECT_FALSE(health[5].measures());
}

}  // namespace
}  // namespace goalmouth
