#include "core/edges/row_edges.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {

void find_row_edges(ChromaRow& row, const EdgeThreshold& threshold, const std::optional<FieldColour>& field,
                    std::vector<RowEdge>& edges) {
    const int w = threshold.window;
    const int n = row.pairs();
    const auto steps = row.squared_steps(w, threshold.chroma_weight);
    const auto peaks = row.peaks(threshold.strength * threshold.strength, w);
    for (std::size_t k = 0; k < peaks.size(); ++k) {
        const int i = peaks[k];
        // Sides are looked at where blur has ended, and before the next edge.
        const int before = k > 0 ? peaks[k - 1] : 0;
        const int after = k + 1 < peaks.size() ? peaks[k + 1] : n;
        const int reach_left = std::max(1, std::min(3 * w, (i - before) / 2));
        const int reach_right = std::max(1, std::min(3 * w, (after - i) / 2));
        RowEdge e;
        e.left = row.mean(i - reach_left, i - 1 - reach_left / 2);
        e.right = row.mean(i + reach_right / 2, i + reach_right - 1);
        e.left_is_field = field && field->contains(e.left);
        e.right_is_field = field && field->contains(e.right);
        if (e.left_is_field && e.right_is_field) continue;
        const auto step_at = [&](int j) {
            return j < 0 || j >= n ? 0.F : std::sqrt(steps[static_cast<std::size_t>(j)]);
        };
        e.strength = step_at(i);
        const float a = step_at(i - 1);
        const float c = step_at(i + 1);
        const float bend = a - 2.F * e.strength + c;
        const float offset = bend < 0.F ? std::clamp(0.5F * (a - c) / bend, -0.5F, 0.5F) : 0.F;
        e.x = 2.F * (static_cast<float>(i) + offset) - 0.5F;
        edges.push_back(e);
    }
}

}  // namespace goalmouth
