#include "core/refinement/row_scatter.h"

#include <cmath>

namespace goalmouth {
RowScatter row_scatter(const std::array<EdgeRows, 2>& rows) {
    RowScatter found;
    double squares = 0.0, total = 0.0;
    std::array<double, 8> together{}, pairs{};  // by how many rows lie between
    for (std::size_t side = 0; side < 2; ++side) {
        // In sigmas of their noise; 0 for rows that hardly count.
        RowColumn<double> standardised, counts;
        standardised.assign(rows[side].count);
        counts.assign(rows[side].count);
        for (std::size_t i = 0; i < rows[side].count; ++i) {
            if (!rows[side].told(i)) continue;
            ++found.looked_at[side];
            if (rows[side].weight[i] < 0.5F) continue;
            ++found.agreeing[side];
            standardised[i] =
                static_cast<double>(rows[side].measured.offset[i]) / std::sqrt(rows[side].variance(i));
            counts[i] = 1.0;
            squares += standardised[i] * standardised[i];
            total += 1.0;
        }
        for (std::size_t k = 1; k <= together.size(); ++k) {
            for (std::size_t i = 0; i < rows[side].count; ++i) {
                together[k - 1] += standardised[i] * standardised[i + k];
                pairs[k - 1] += counts[i] * counts[i + k];
            }
        }
    }
    constexpr double least = 8.0, fitted = 4.0;  // rows; parameters
    found.enough = total > least;
    if (!found.enough) return found;
    found.variance = squares / (total - fitted);
    for (std::size_t k = 0; k < together.size(); ++k) {
        if (!(pairs[k] > least)) break;
        const double similar = together[k] / pairs[k] * total / squares;
        if (!(similar >= 1.6 / std::sqrt(pairs[k]))) break;
        found.correlation += 2.0 * similar;
    }
    return found;
}

}  // namespace goalmouth
