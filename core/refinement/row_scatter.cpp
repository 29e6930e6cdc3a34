#include "core/refinement/row_scatter.h"

#include <cmath>

namespace goalmouth {
namespace {

double standardised(const EdgeRow& row) {
    const double variance = 1.0 / static_cast<double>(row.information) + edge_roughness * edge_roughness;
    return static_cast<double>(row.offset) / std::sqrt(variance);
}

}  // namespace

RowScatter row_scatter(const std::array<std::vector<EdgeRow>, 2>& rows) {
    RowScatter found;
    double squares = 0.0, total = 0.0;
    std::array<double, 8> together{}, pairs{};  // by how many rows lie between
    for (std::size_t side = 0; side < 2; ++side) {
        for (std::size_t i = 0; i < rows[side].size(); ++i) {
            const EdgeRow& row = rows[side][i];
            if (!row.seen || !(row.information > 0.0F)) continue;
            ++found.looked_at[side];
            if (row.weight < 0.5F) continue;
            ++found.agreeing[side];
            const double s = standardised(row);
            squares += s * s;
            total += 1.0;
            for (std::size_t k = 1; k <= together.size() && i + k < rows[side].size(); ++k) {
                const EdgeRow& other = rows[side][i + k];
                if (!other.seen || !(other.information > 0.0F) || !(other.weight >= 0.5F)) continue;
                together[k - 1] += s * standardised(other);
                pairs[k - 1] += 1.0;
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
