#pragma once

#include "core/evaluation/statistics.h"
#include "tools/evaluate/paper_run.h"

#include <array>
#include <optional>
#include <vector>

namespace goalmouth {

/// How well one post of the goal was measured, over frames. Distances in metres.
struct PostSummary {
    int posts = 0;                               // frames in which it counts
    int detected = 0;                            // of those, by the rule
    int identified = 0;                          // of those, a detection means it
    int measured = 0;                            // of those, with a distance: what stands behind `distance`
    std::optional<ErrorStatistics> distance;     // m, estimate − truth
    std::optional<std::array<double, 2>> edges;  // px, mean offset of left and right edge, of detected ones
    std::optional<double> bearing_rmse;          // rad, of detected ones
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

/// Sums over records in their order.
Summary summarise(const std::vector<const DetectorRecord*>& records);

/// A run's records by detector, scene and cell, in the order of the run.
class RecordTable {
  public:
    /// The records must outlive the table.
    RecordTable(const std::vector<FrameRecord>& records, std::size_t scenes);

    Summary cell(std::size_t detector, std::size_t scene, int cell) const;
    /// All distances of a tilt, by its place in cell_tilts_deg, pooled.
    Summary tilt(std::size_t detector, std::size_t scene, std::size_t tilt) const;

    /// All cells together.
    Summary whole(std::size_t detector, std::size_t scene) const;

  private:
    std::vector<std::vector<const FrameRecord*>> cells_;  // scene · cell_count + cell
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
