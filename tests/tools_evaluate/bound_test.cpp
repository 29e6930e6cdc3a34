#include "tools/evaluate/paper_acceptance.h"
#include "tools/evaluate/paper_run.h"
#include "tools/evaluate/paper_settings.h"
#include "tools/evaluate/paper_setup.h"
#include "tools/evaluate/paper_summary.h"

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

namespace goalmouth {
namespace {

using testing::HasSubstr;

/// The frame that a detector is asked about: it follows from its number.
class TrueFrames {
  public:
    explicit TrueFrames(const PaperGrid& grid)
        : renderer_(grid.scenes[0], grid.field, grid.camera, grid.seed) {}
    CellFrame frame(std::int64_t seq) {
        return renderer_.render(static_cast<int>(seq / most_frames_per_cell),
                                static_cast<int>(seq % most_frames_per_cell));
    }
    const Intrinsics& camera() const { return renderer_.camera(); }

  private:
    CellRenderer renderer_;
};

/// A detector that knows the truth: the post in line as it is, flagged as refined, its distance off by a
/// normal error of the bound, which its covariance states. `change` may spoil it; `bound` [m].
Detector knowing(const PaperGrid& grid, const std::string& name,
                 const std::function<void(Post&, double bound, std::int64_t seq)>& change) {
    return {name, [&grid, change]() -> DetectPosts {
                const auto frames = std::make_shared<TrueFrames>(grid);
                return [=](const DetectorInput& input) {
                    const CellFrame frame = frames->frame(input.seq);
                    std::vector<Post> posts;
                    if (!frame.sight) return posts;
                    constexpr double bearing_sigma = 1e-3;
                    const double bound = frame.sight->bound.value().distance_sigma();
                    for (const KnownPost& known : frame.posts) {
                        if (known.truth.id != post_in_line) continue;
                        Random random(static_cast<std::uint64_t>(input.seq) + 77);
                        Post& post = posts.emplace_back();
                        post.left_top = known.outline.left_top;
                        post.left_base = known.outline.left_base;
                        post.right_top = known.outline.right_top;
                        post.right_base = known.outline.right_base;
                        post.flags = post_flag::refined;
                        post.distance_m = known.truth.distance_m + bound * random.normal();
                        const double row =
                            0.25 * (post.left_top + post.left_base + post.right_top + post.right_base).y();
                        post.bearing_rad = bearing_in_row(known.outline, frames->camera(), row) +
                                           bearing_sigma * random.normal();
                        post.covariance =
                            Eigen::Vector2d(bound * bound, bearing_sigma * bearing_sigma).asDiagonal();
                        change(post, bound, input.seq);
                    }
                    return posts;
                };
            }};
}

PaperSetup lit_setup(int frames_per_cell) {
    PaperOptions options;
    options.frames_per_cell = frames_per_cell;
    options.detectors = "ransac";
    options.scenes = "lit";
    options.size = "320x240";
    return set_up_paper(options);
}

TEST(Bound, ShowsBiasNoiseOverconfidenceAndRefusalInTheirColumns) {
    const PaperSetup setup = lit_setup(6);
    const PaperGrid& grid = setup.grid;
    const std::vector<Detector> detectors = {
        knowing(grid, "at the bound", [](Post&, double, std::int64_t) {}),
        knowing(grid, "biased",
                [](Post& post, double bound, std::int64_t) { post.distance_m += 2.0 * bound; }),
        knowing(grid, "noisy",
                [](Post& post, double bound, std::int64_t seq) {
                    post.distance_m +=
                        std::sqrt(8.0) * bound * Random(static_cast<std::uint64_t>(seq)).normal();
                }),
        knowing(grid, "overconfident", [](Post& post, double, std::int64_t) { post.covariance /= 4.0; }),
        knowing(grid, "picky",
                [](Post& post, double, std::int64_t seq) {
                    if (seq % 2 == 0) return;
                    post.flags = 0;
                    post.distance_m += 5.0;
                }),
        knowing(grid, "without covariance",
                [](Post& post, double, std::int64_t) { post.covariance(0, 0) = -1.0; }),
        knowing(grid, "plain", [](Post& post, double, std::int64_t) { post.flags = 0; }),
    };
    PaperWork work;
    work.jobs = 2;
    const std::vector<FrameRecord> records = run_paper(grid, detectors, work);
    const RecordTable table(records, 1);
    const auto of = [&](std::size_t detector) { return table.whole(detector, 0).in_line; };

    const PostSummary exact = of(0);
    EXPECT_EQ(exact.measured, exact.posts);
    EXPECT_NEAR(exact.rmse_to_bound().value(), 1.0, 0.3);
    EXPECT_NEAR(exact.median_to_bound().value(), 1.0, 0.5);
    EXPECT_NEAR(exact.normalised_error.value(), 1.0, 0.3);
    EXPECT_EQ(exact.good_share(), 1.0);
    EXPECT_GT(exact.both_edges, exact.posts * 9 / 10);

    EXPECT_NEAR(of(1).rmse_to_bound().value(), std::sqrt(5.0), 0.5);
    EXPECT_NEAR(of(1).normalised_error.value(), 3.0, 0.7) << "(1 + 4 + 1)/2";
    EXPECT_NEAR(of(2).rmse_to_bound().value(), 3.0, 0.8);
    EXPECT_NEAR(of(3).normalised_error.value(), 4.0 * exact.normalised_error.value(), 1e-6);
    EXPECT_NEAR(of(3).rmse_to_bound().value(), exact.rmse_to_bound().value(), 1e-9);

    EXPECT_NEAR(of(4).good_share().value(), 0.5, 0.05);
    EXPECT_NEAR(of(4).measured, 0.5 * exact.measured, 3);
    EXPECT_NEAR(of(4).rmse_to_bound().value(), 1.0, 0.4);
    EXPECT_EQ(of(4).all_measured, exact.measured);
    EXPECT_GT(of(4).all.value().rmse, 3.0) << "half of them are 5 m off";
    EXPECT_EQ(of(5).normalised_error, largest_normalised_error);

    EXPECT_FALSE(table.refines(6));
    EXPECT_NEAR(of(6).rmse_to_bound().value(), exact.rmse_to_bound().value(), 1e-12);
    EXPECT_FALSE(of(6).normalised_error);
    EXPECT_EQ(of(6).good, 0);
}

TEST(Bound, HandsEachFrameWhatTheRobotMeasured) {
    const PaperSetup setup = lit_setup(1);
    int seen = 0;
    const Detector curious{"curious", [&]() -> DetectPosts {
                               const auto frames = std::make_shared<TrueFrames>(setup.grid);
                               return [&seen, frames](const DetectorInput& input) {
                                   const Eigen::Isometry3d T_WC = frames->frame(input.seq).view.camera.T_WC;
                                   const Eigen::AngleAxisd error(input.kinematics.value().T_BC.linear() *
                                                                 T_WC.linear().transpose());
                                   EXPECT_GT(error.angle(), 1e-5);
                                   EXPECT_LT(error.angle(), 0.12);
                                   EXPECT_GT(input.kinematics->covariance(3, 3), 1e-5);
                                   ++seen;
                                   return std::vector<Post>{};
                               };
                           }};
    run_paper(setup.grid, {curious}, {});
    EXPECT_EQ(seen, cell_count);
}

// ---------------------------------------------------------------------------------------------------------

/// One post in line, called good, `error` and `bound` in metres.
DetectorRecord refined_record(double error, double bound) {
    DetectorRecord r;
    r.posts = r.detected = r.identified = 1;
    r.in_line.counts = r.in_line.found = r.in_line.identified = true;
    r.in_line.distance_error = error;
    r.in_line.edges = {0.0, 0.0};
    r.in_line.bearing_error = 0.0;
    r.in_line.good = r.in_line.both_edges = true;
    r.in_line.bound = bound;
    r.in_line.normalised_error = 1.0;
    return r;
}

DetectorRecord plain_record(double error) {
    DetectorRecord r = refined_record(error, 0.01);
    r.in_line.good = false;
    r.in_line.normalised_error = std::nullopt;
    return r;
}

/// Errors of ± 1 cm at a bound of 1 cm in every cell; RANSAC's are 20 cm.
PaperResult result_at_the_bound(const std::string& scene) {
    PaperResult result;
    result.scenes = {scene};
    result.detectors = {"ransac", "refined"};
    result.options.frames_per_cell = 2;
    result.settings = {{"detectors", nlohmann::ordered_json::object()}};
    for (int cell = 0; cell < cell_count; ++cell)
        for (int index = 0; index < 2; ++index)
            result.records.push_back(
                {{0, cell, index}, {plain_record(0.2), refined_record(index == 0 ? 0.01 : -0.01, 0.01)}});
    return result;
}

std::vector<AcceptanceLine> lines_of(const PaperResult& result) {
    return paper_acceptance(result,
                            {result.records, 1, refining_detectors(result.settings, result.detectors)});
}

TEST(PaperAcceptance, HoldsWhereEveryCellDoes) {
    const std::vector<std::pair<std::string, std::size_t>> expected = {
        {"lit", 4}, {"clutter", 4}, {"match", 1}, {"flat", 0}};
    for (const auto& [scene, count] : expected) {
        SCOPED_TRACE(scene);
        const auto lines = lines_of(result_at_the_bound(scene));
        EXPECT_EQ(lines.size(), count);
        for (const AcceptanceLine& line : lines) EXPECT_TRUE(line.holds) << line.text();
    }
    EXPECT_THAT(lines_of(result_at_the_bound("lit"))[2].text(),
                HasSubstr("refined, lit: RMSE over all cells ≤ 1/15 of ransac's: 1/20.0"));
}

TEST(PaperAcceptance, NamesTheWorstCell) {
    PaperResult result = result_at_the_bound("lit");
    for (int index = 0; index < 2; ++index) {
        result.records[2 * 16 + index].detectors[1].in_line.distance_error = index == 0 ? 0.02 : -0.02;
        result.records[2 * 9 + index].detectors[1].in_line.distance_error = 0.012;
        result.records[2 * 7 + index].detectors[1].in_line.normalised_error = 30.0;
    }
    const auto lines = lines_of(result);
    EXPECT_FALSE(lines[0].holds);
    EXPECT_THAT(lines[0].text(), HasSubstr("at worst 1.54 of that, 530 cm, 20°"));
    EXPECT_THAT(lines[0].text(), HasSubstr("does not hold"));
    EXPECT_FALSE(lines[1].holds);
    EXPECT_THAT(lines[1].text(), HasSubstr("at worst 0.92 of it, 350 cm, 10°"));
    EXPECT_TRUE(lines[2].holds);
    EXPECT_FALSE(lines[3].holds);
    EXPECT_THAT(lines[3].text(), HasSubstr("2.61, most 30.00, 150 cm, 10°"));
}

TEST(PaperAcceptance, AsksLessNearBy) {
    EXPECT_DOUBLE_EQ(rmse_bar({60, 0}, 1e-5), 0.0009);
    EXPECT_DOUBLE_EQ(rmse_bar({150, 0}, 1e-2), 0.013);
    EXPECT_DOUBLE_EQ(rmse_bar({300, 0}, 1e-5), 1.3e-5);
}

TEST(PaperAcceptance, DoesNotHoldWhereACellIsNotMeasuredOrFramesAreRefused) {
    PaperResult result = result_at_the_bound("lit");
    PostRecord nothing_found;
    nothing_found.counts = nothing_found.both_edges = true;
    for (int index = 0; index < 2; ++index) result.records[index].detectors[1].in_line = nothing_found;
    const auto lines = lines_of(result);
    EXPECT_FALSE(lines[0].holds);
    EXPECT_THAT(lines[0].text(), HasSubstr("1 cells without"));
    result.scenes = {"clutter"};
    const auto clutter = lines_of(result);
    EXPECT_FALSE(clutter[2].holds);
    EXPECT_THAT(clutter[2].text(),
                HasSubstr("94.4 % (34 of 36; the detector found 34 of them), fewest 0.0 %, 60 cm, 0°"));
    result.detectors = {"ransac", "other"};
    for (FrameRecord& record : result.records) record.detectors[1] = plain_record(0.2);
    EXPECT_TRUE(lines_of(result).empty()) << "nothing is asked of chains that do not refine";
}

TEST(PaperAcceptance, OfAChainThatRefinesNothingNothingHolds) {
    PaperResult result = result_at_the_bound("lit");
    result.settings["detectors"]["refined"]["refinement"]["executable"] = "refinement";
    for (FrameRecord& record : result.records) record.detectors[1] = plain_record(0.2);
    const auto lines = lines_of(result);
    EXPECT_GE(lines.size(), 3U);
    for (const AcceptanceLine& line : lines) EXPECT_FALSE(line.holds) << line.text();
}

TEST(PaperAcceptance, SaysOfHowManyPostsItSpeaks) {
    PaperResult result = result_at_the_bound("match");
    for (int cell = 0; cell < cell_count; ++cell)
        result.records[static_cast<std::size_t>(2 * cell)].detectors[1].in_line.good = false;
    EXPECT_THAT(lines_of(result)[0].text(), HasSubstr("of frames that show both edges it calls 50.0 % good"));
}

}  // namespace
}  // namespace goalmouth
