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
    const std::size_t begin = edges.size();
    const auto step_at = [&](int i) {
        return i < 0 || i >= n ? 0.F : std::sqrt(steps[static_cast<std::size_t>(i)]);
    };
    for (const int i : peaks) {
        RowEdge e;
        e.strength = step_at(i);
        const float a = step_at(i - 1);
        const float c = step_at(i + 1);
        const float bend = a - 2.F * e.strength + c;
        const float offset = bend < 0.F ? std::clamp(0.5F * (a - c) / bend, -0.5F, 0.5F) : 0.F;
        e.x = 2.F * (static_cast<float>(i) + offset) - 0.5F;
        edges.push_back(e);
    }
    // Sides are looked at where blur has ended, and before the next edge.
    std::size_t kept = begin;
    for (std::size_t k = begin; k < edges.size(); ++k) {
        RowEdge e = edges[k];
        const int i = peaks[k - begin];
        const int before = k > begin ? peaks[k - begin - 1] : 0;
        const int after = k + 1 < edges.size() ? peaks[k + 1 - begin] : n;
        const int reach_left = std::max(1, std::min(3 * w, (i - before) / 2));
        const int reach_right = std::max(1, std::min(3 * w, (after - i) / 2));
        e.left = row.mean(i - reach_left, i - 1 - reach_left / 2);
        e.right = row.mean(i + reach_right / 2, i + reach_right - 1);
        e.left_is_field = field && field->contains(e.left);
        e.right_is_field = field && field->contains(e.right);
        if (e.left_is_field && e.right_is_field) continue;
        edges[kept++] = e;
    }
    edges.resize(kept);
}

}  // namespace goalmouth
