#include "tools/evaluate/paper_run.h"
#include "tools/evaluate/paper_setup.h"
#include "tools/evaluate/paper_summary.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

/// By tilt, in scene `flat`, all distances together.
std::vector<Summary> by_tilt(const std::string& detector, int frames_per_cell) {
    PaperOptions options;
    options.frames_per_cell = frames_per_cell;
    options.detectors = detector;
    const PaperSetup setup = set_up_paper(options);
    PaperWork work;
    work.jobs = 2;
    const std::vector<FrameRecord> records = run_paper(setup.grid, setup.detectors, work);
    const RecordTable table(records, 1);
    std::vector<Summary> summaries;
    for (std::size_t tilt = 0; tilt < cell_tilts_deg.size(); ++tilt)
        summaries.push_back(table.tilt(0, 0, tilt));
    return summaries;
}

// The paper's claims, with its parameters. RANSAC misses 1.5 % of the posts at 20°: of fewer frames chance
// would decide.
TEST(Acceptance, RansacFindsAndMeasuresPostsAtEveryTiltAndTheHistogramDoesNot) {
    const std::vector<Summary> ransac = by_tilt("ransac", 100);
    for (std::size_t tilt = 0; tilt < ransac.size(); ++tilt) {
        SCOPED_TRACE(std::to_string(cell_tilts_deg[tilt]) + " degrees");
        ASSERT_TRUE(ransac[tilt].in_line.distance);
        EXPECT_GE(ransac[tilt].detection_rate(), 0.98);
        EXPECT_LE(ransac[tilt].in_line.distance->rmse, 0.31);
    }
    const std::vector<Summary> histogram = by_tilt("histogram", 15);
    ASSERT_TRUE(histogram.front().in_line.distance);
    ASSERT_TRUE(histogram.back().in_line.distance);
    const double worst = histogram.back().in_line.distance->rmse;
    EXPECT_GT(worst, histogram.front().in_line.distance->rmse);
    EXPECT_GT(worst, 3.0 * ransac.back().in_line.distance->rmse);
}

}  // namespace
}  // namespace goalmouth
