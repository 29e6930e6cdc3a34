#include "core/evaluation/cell.h"
#include "tools/evaluate/paper_failures.h"
#include "tools/evaluate/paper_headline.h"
#include "tools/evaluate/paper_summary.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace goalmouth {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// One post, in line; `error`: of its distance [m].
DetectorRecord record(bool found, double error, int false_posts = 0) {
    DetectorRecord r;
    r.posts = 1;
    r.detected = found ? 1 : 0;
    r.identified = 1;
    r.false_posts = false_posts;
    r.in_line = {true, found, true, error, std::nullopt, std::nullopt};
    return r;
}

/// One frame in each cell of one scene, all found and 0.02 m off by the one detector, 0.2 m by the other.
PaperResult good_result() {
    PaperResult result;
    result.scenes = {"flat"};
    result.detectors = {"histogram", "ransac"};
    result.options.frames_per_cell = 1;
    for (int cell = 0; cell < cell_count; ++cell)
        result.records.push_back({{0, cell, 0}, {record(true, -0.2), record(true, 0.02)}});
    return result;
}

std::string caption(const DetectorRecord& of, int cell, std::size_t rank = 0) {
    return failure_caption({{0, cell, 7}, {of}}, of, {0, WorstFrame::Kind::distance, rank});
}

TEST(Enumeration, PutsAnAndBeforeTheLast) {
    EXPECT_EQ(enumeration({}), "");
    EXPECT_EQ(enumeration({"a"}), "a");
    EXPECT_EQ(enumeration({"a", "b"}), "a and b");
    EXPECT_EQ(enumeration({"a", "b", "c"}), "a, b and c");
}

TEST(PaperHeadline, ComparesRmseAndNamesTheWorstCells) {
    PaperResult result = good_result();
    result.records[5].detectors[1] = record(false, 0.03);
    result.records[16].detectors[1] = record(true, -1.0);
    const RecordTable table(result.records, 1);
    const auto paragraphs = paper_headline(result, table);
    ASSERT_EQ(paragraphs.size(), 2U);
    EXPECT_THAT(paragraphs[0], HasSubstr("18 rendered frames of 640x480"));
    EXPECT_THAT(paragraphs[0], HasSubstr("by histogram and ransac"));
    EXPECT_THAT(paragraphs[1],
                HasSubstr("the histogram's RMSE of the distance is 0.5 times RANSAC's in scene flat"));
    EXPECT_THAT(paragraphs[1], HasSubstr("fewest posts (0.0 %) in scene flat, 600 cm, 0°"));
    EXPECT_THAT(paragraphs[1], HasSubstr("largest (100.0 cm) in scene flat, 530 cm, 20°"));
}

TEST(PaperHeadline, SaysLessOfLess) {
    PaperResult result = good_result();
    EXPECT_THAT(paper_headline(result, {result.records, 1})[1], HasSubstr("RANSAC finds every post"));
    result.detectors = {"mine", "other"};
    const auto of_others = paper_headline(result, {result.records, 1});
    EXPECT_THAT(of_others[1], HasSubstr("mine finds every post"));
    EXPECT_EQ(of_others[1].find("histogram"), std::string::npos);
    result.records.clear();
    EXPECT_EQ(paper_headline(result, {result.records, 1}).size(), 1U);
}

TEST(WorstCells, AreByDetectionAndByRmse) {
    PaperResult result = good_result();
    result.records[3].detectors[1] = record(false, 0.1);
    result.records[4].detectors[1] = record(false, 0.2);
    result.records[17].detectors[1] = record(true, 0.5);
    const RecordTable table(result.records, 1);
    const WorstCells all = worst_cells(table, 1, 0);
    EXPECT_EQ(all.detection, 4) << "as few as in cell 3, and farther off";
    EXPECT_EQ(all.distance, 17);
    const WorstCells first_tilt = worst_cells(table, 1, 0, 0);
    EXPECT_EQ(first_tilt.detection, 4);
    EXPECT_EQ(first_tilt.distance, 4);
    const std::vector<FrameRecord> none;
    EXPECT_FALSE(worst_cells({none, 1}, 1, 0).detection);
}

TEST(WorstFrames, AreOfEveryKindAndNamedOnce) {
    PaperResult result = good_result();
    result.records[2].detectors[1] = record(false, 3.0, 5);
    result.records[0].detectors[1] = record(false, 0.0, 1);
    result.records[9].detectors[1] = record(true, 0.0, 2);
    std::vector<std::size_t> places;
    for (const WorstFrame& each : worst_frames(result, 1, 0)) places.push_back(each.record);
    EXPECT_THAT(places, ElementsAre(2, 1, 0, 9)) << "distance, distance, missed, false";
    EXPECT_EQ(worst_frames(result, 1, 0)[1].rank, 1U);
}

TEST(FailureCaption, IsShortAndSaysWhyItIsThere) {
    EXPECT_EQ(caption(record(false, -4.97, 1), 17),
              "600 cm, 20°: 0 of 1 found, 1 false, distance 4.97 m short");
    EXPECT_EQ(caption(record(false, 0.31), 0), "60 cm, 0°: 0 of 1 found, distance 31 cm long");
    EXPECT_EQ(caption(record(true, 0.31), 0),
              "Largest distance error: 60 cm, 0°: 1 of 1 found, distance 31 cm long");
    EXPECT_THAT(caption(record(true, 0.2), 0, 1), HasSubstr("Second largest distance error: "));
    EXPECT_THAT(caption(record(true, 0.001, 3), 6), HasSubstr("3 false, distance right"));
    EXPECT_THAT(caption(record(true, -0.997, 1), 6), HasSubstr("1.00 m short"));
}

}  // namespace
}  // namespace goalmouth
