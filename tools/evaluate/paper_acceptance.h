#pragma once

#include "core/evaluation/cell.h"
#include "tools/evaluate/paper_result.h"
#include "tools/evaluate/paper_summary.h"

#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// What the RMSE of a cell may be where the bound is `bound` [m]: 1.3 times that; nearer than 3 m at least
/// 0.15 % of the distance, because what no picture tells (lens, vertical) counts for more there.
double rmse_bar(const EvaluationCell& cell, double bound);

/// |bias| as a share of rmse_bar. Nothing where nothing was measured.
std::optional<double> bias_to_bar(const PostSummary& post, const EvaluationCell& cell);

/// One thing that is asked of a chain that refines, and what came of it.
struct AcceptanceLine {
    std::string detector;
    std::string scene;
    std::string what;  // "RMSE ≤ 1.3 × bound …: at worst 1.12 of it, 600 cm, 20° (2.31 of 2.06 cm)"
    bool holds = false;

    std::string text() const;  // "refined, lit: … – holds"
};

/// What is asked of chains that refine in the scenes lit, clutter and match. For other detectors and scenes
/// nothing. A cell in which nothing was measured does not hold.
std::vector<AcceptanceLine> paper_acceptance(const PaperResult& result, const RecordTable& table);

}  // namespace goalmouth
