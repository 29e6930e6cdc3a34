#pragma once

#include "tools/evaluate/paper_result.h"
#include "tools/evaluate/paper_summary.h"
#include "tools/evaluate/report/html_table.h"

#include <cstddef>

namespace goalmouth {

// The tables of the page.

/// The paper's figures, then a row for each detector in each scene: posts found and RMSE by tilt, false
/// posts, the cells in which it does worst.
Table overview_table(const PaperResult& result, const RecordTable& table);

/// The same with all statistics, a row for each tilt.
Table tilt_table(const PaperResult& result, const RecordTable& table);

/// A row for each distance and tilt.
Table cell_table(const PaperResult& result, const RecordTable& table, std::size_t detector,
                 std::size_t scene);

/// The same against the bound.
Table bound_table(const PaperResult& result, const RecordTable& table, std::size_t detector,
                  std::size_t scene);

}  // namespace goalmouth
