#pragma once

#include "core/extraction/border.h"
#include "core/extraction/candidate_parameters.h"
#include "core/extraction/runs.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace goalmouth {

/// Groups runs of rows that lie one above the other into regions, and judges these.
class RunRegions {
  public:
    /// Leaves the runs whose region is large enough and stands on the field. `runs` are horizontal, row by
    /// row from top to bottom and along each row from left to right. No heap allocation once warm.
    void keep_good(std::vector<Run>& runs, const FieldBorder& border, int image_height,
                   const CandidateParameters& parameters);

  private:
    struct Region {
        int rows = 0;
        int last_row = -1;
        bool stands = false;
    };
    struct Row {
        int row;
        std::size_t begin;  // of its runs
        std::size_t end;
    };

    void split_into_rows(const std::vector<Run>& runs);
    void merge_overlapping(const std::vector<Run>& runs, const Row& upper, const Row& lower);
    std::uint32_t find(std::uint32_t i);

    std::vector<Row> rows_;
    std::vector<std::uint32_t> parent_;  // sets that merge: union-find with path halving
    std::vector<Region> regions_;        // at each set's representative
};

}  // namespace goalmouth
