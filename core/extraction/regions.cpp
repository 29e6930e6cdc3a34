#include "core/extraction/regions.h"

#include <algorithm>
#include <numeric>

namespace goalmouth {

void RunRegions::keep_good(std::vector<Run>& runs, const FieldBorder& border, int image_height,
                           const CandidateParameters& parameters) {
    parent_.resize(runs.size());
    std::iota(parent_.begin(), parent_.end(), 0U);
    split_into_rows(runs);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        for (std::size_t j = i; j-- > 0 && rows_[i].row - rows_[j].row <= parameters.region_gap;)
            merge_overlapping(runs, rows_[j], rows_[i]);
    }

    regions_.assign(runs.size(), {});
    const bool judge_position = parameters.must_reach_border && !border.empty();
    const double tolerance = parameters.border_tolerance * image_height;
    // From the bottom, where a region that stands on the field does so.
    for (std::size_t i = runs.size(); i-- > 0;) {
        Region& region = regions_[find(static_cast<std::uint32_t>(i))];
        region.rows += runs[i].row != region.last_row;
        region.last_row = runs[i].row;
        if (region.stands) continue;
        const Eigen::Vector2d centre = runs[i].segment.centre();
        region.stands = !judge_position || centre.y() >= border.y_at(centre.x()) - tolerance;
    }

    std::size_t kept = 0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const Region& region = regions_[find(static_cast<std::uint32_t>(i))];
        if (region.stands && region.rows >= parameters.least_rows) runs[kept++] = runs[i];
    }
    runs.resize(kept);
}

void RunRegions::split_into_rows(const std::vector<Run>& runs) {
    rows_.clear();
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (rows_.empty() || rows_.back().row != runs[i].row) rows_.push_back({runs[i].row, i, i});
        rows_.back().end = i + 1;
    }
}

/// Overlapping or touching, also across a corner. Both rows are in order: whichever run ends first meets no
/// later one.
void RunRegions::merge_overlapping(const std::vector<Run>& runs, const Row& upper, const Row& lower) {
    std::size_t i = upper.begin;
    std::size_t j = lower.begin;
    while (i != upper.end && j != lower.end) {
        const CandidateSegment& a = runs[i].segment;
        const CandidateSegment& b = runs[j].segment;
        if (a.start <= b.end + 1 && b.start <= a.end + 1)
            parent_[find(static_cast<std::uint32_t>(i))] = find(static_cast<std::uint32_t>(j));
        ++(a.end < b.end ? i : j);
    }
}

std::uint32_t RunRegions::find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
}

}  // namespace goalmouth
