#include "core/edges/row_edges.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {

void RowEdgeFinder::find(ChromaRow& row, const EdgeThreshold& threshold,
                         const std::optional<FieldColour>& field, std::vector<RowEdge>& edges) {
    row.squared_steps(threshold.window, threshold.chroma_weight, steps_);
    const int w = threshold.window;
    const int n = row.pairs();
    const std::size_t begin = edges.size();
    places_.clear();
    const float least = threshold.strength * threshold.strength;
    for (int i = w; i + w <= n; ++i) {
        const float here = steps_[static_cast<std::size_t>(i)];
        if (here < least) continue;
        bool largest = true;
        for (int k = 1; k <= w && largest; ++k) {
            largest = !(i - k >= 0 && steps_[static_cast<std::size_t>(i - k)] > here) &&
                      !(i + k < n && steps_[static_cast<std::size_t>(i + k)] >= here);
        }
        if (!largest) continue;
        RowEdge e;
        e.strength = std::sqrt(here);
        const float a = std::sqrt(steps_[static_cast<std::size_t>(i - 1)]);
        const float c = i + 1 < n ? std::sqrt(steps_[static_cast<std::size_t>(i + 1)]) : 0.F;
        const float bend = a - 2.F * e.strength + c;
        const float offset = bend < 0.F ? std::clamp(0.5F * (a - c) / bend, -0.5F, 0.5F) : 0.F;
        e.x = 2.F * (static_cast<float>(i) + offset) - 0.5F;
        edges.push_back(e);
        places_.push_back(i);
    }
    // Sides are looked at where blur has ended, and before the next edge.
    std::size_t kept = begin;
    for (std::size_t k = begin; k < edges.size(); ++k) {
        RowEdge e = edges[k];
        const int i = places_[k - begin];
        const int before = k > begin ? places_[k - begin - 1] : 0;
        const int after = k + 1 < edges.size() ? places_[k + 1 - begin] : n;
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
