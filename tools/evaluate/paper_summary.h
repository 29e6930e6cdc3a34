#pragma once

#include "core/evaluation/statistics.h"
#include "tools/evaluate/paper_run.h"

#include <array>
#include <optional>
#include <vector>

namespace goalmouth {

/// How well one post of the goal was measured, over frames. Distances in metres.
struct PostSummary {
    int posts = 0;       // frames in which it counts
    int detected = 0;    // of those, by the rule
    int identified = 0;  // of those, a detection means it
    /// m, estimate − truth, over identified posts with a distance; of a chain that refines, over those of
    /// them that it calls good.
    std::optional<ErrorStatistics> distance;
    int measured = 0;                            // what stands behind it
    std::optional<ErrorStatistics> all;          // m, over all identified posts with a distance
    int all_measured = 0;                        // what stands behind that
    std::optional<std::array<double, 2>> edges;  // px, mean offset of left and right edge, of detected ones
    std::optional<double> bearing_rmse;          // rad, of detected ones

    // Of the post in line alone.
    int both_edges = 0;                      // frames that show both its edges
    int both_edges_identified = 0;           // of those, a detection means it: the others nobody can refine
    int good = 0;                            // of those, called good
    std::optional<double> bound;             // m, root of the mean square of the bounds behind `distance`
    std::optional<double> bound_median;      // m, of the same
    std::optional<double> normalised_error;  // mean of PostRecord::normalised_error

    std::optional<double> rmse_to_bound() const;
    /// Median |error| as a share of what a normal error of the median bound has: 0.6745 of it.
    std::optional<double> median_to_bound() const;
    std::optional<double> good_share() const;
};

/// One detector over some frames.
struct Summary {
    int frames = 0;
    int posts = 0;
    int detected = 0;
    int identified = 0;
    int false_posts = 0;
    PostSummary in_line;
    PostSummary second;

    double detection_rate() const { return posts > 0 ? static_cast<double>(detected) / posts : 0.0; }
    double false_per_frame() const { return frames > 0 ? static_cast<double>(false_posts) / frames : 0.0; }
};

/// Sums over records in their order. `refines`: the detector says of its posts whether they are good.
Summary summarise(const std::vector<const DetectorRecord*>& records, bool refines = false);

/// A run's records by detector, scene and cell, in the order of the run.
class RecordTable {
  public:
    /// The records must outlive the table. `refining`: detectors known to refine, whatever they say of posts.
    RecordTable(const std::vector<FrameRecord>& records, std::size_t scenes, std::vector<bool> refining = {});

    /// Whether a detector is known to refine or called any post good.
    bool refines(std::size_t detector) const { return detector < refines_.size() && refines_[detector]; }

    Summary cell(std::size_t detector, std::size_t scene, int cell) const;
    /// All distances of a tilt, by its place in cell_tilts_deg, pooled.
    Summary tilt(std::size_t detector, std::size_t scene, std::size_t tilt) const;

    /// All cells together.
    Summary whole(std::size_t detector, std::size_t scene) const;

    /// Two detectors over all cells, in the frames in which both measured the post in line.
    struct Comparison {
        int frames = 0;
        double rmse = 0.0;        // m, of `detector`, where it refines over frames it calls good
        double other_rmse = 0.0;  // m
    };
    std::optional<Comparison> compare(std::size_t detector, std::size_t other, std::size_t scene) const;

  private:
    std::vector<std::vector<const FrameRecord*>> cells_;  // scene · cell_count + cell
    std::vector<bool> refines_;                           // by detector
};

/// The two cells in which a detector does worst, which need not be the same.
struct WorstCells {
    std::optional<int> detection;  // the lowest rate; of equal ones, that with the largest RMSE
    std::optional<int> distance;   // the largest RMSE of the post in line
};

/// Of one tilt (its place in cell_tilts_deg) or of all. Nothing where no post counts or none was measured.
WorstCells worst_cells(const RecordTable& table, std::size_t detector, std::size_t scene,
                       std::optional<std::size_t> tilt = std::nullopt);

}  // namespace goalmouth
