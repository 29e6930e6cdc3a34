#pragma once

#include "core/refinement/whole_numbers.h"

#include <array>
#include <cstddef>
#include <vector>

namespace goalmouth {

/// px, sigma of edges as cameras show them, from row to row, beside what noise explains.
inline constexpr double edge_roughness = 0.02;

/// A number for each row of an edge. Before and behind them there is room for the neighbours of the first and
/// the last and for whole vectors, which holds zeros.
template <class T>
class RowColumn {
  public:
    static constexpr std::size_t room = 48;

    /// All zero.
    void assign(std::size_t rows) { values_.assign(rows + 2 * room, T{}); }
    T& operator[](std::size_t i) { return values_[room + i]; }
    const T& operator[](std::size_t i) const { return values_[room + i]; }
    T* data() { return values_.data() + room; }
    const T* data() const { return values_.data() + room; }

  private:
    std::vector<T> values_;
};

/// What the pixels of each row say, once they are measured (row_measurement.h).
struct RowMeasurements {
    RowColumn<float> own_inner, own_outer;  // levels inside and outside, from pixels well away from the edge
    RowColumn<float> own_inner_weight, own_outer_weight;  // pixels they are the mean of
    RowColumn<float> offset;                              // px, outwards from where the edge was supposed
    RowColumn<float> information;                         // 1/px², one over the offset's variance
    RowColumn<float> misfit;   // mean square of what the edge model leaves, for each degree of freedom
    RowColumn<float> freedom;  // degrees of freedom of misfit

    using Columns = std::array<RowColumn<float> RowMeasurements::*, 8>;
    static constexpr Columns columns();
    void assign(std::size_t rows) {
        for (const auto column : columns()) (this->*column).assign(rows);
    }
    void copy(const RowMeasurements& other, std::size_t row) {
        for (const auto column : columns()) (this->*column)[row] = (other.*column)[row];
    }
};

constexpr RowMeasurements::Columns RowMeasurements::columns() {
    return {&RowMeasurements::own_inner,        &RowMeasurements::own_outer,
            &RowMeasurements::own_inner_weight, &RowMeasurements::own_outer_weight,
            &RowMeasurements::offset,           &RowMeasurements::information,
            &RowMeasurements::misfit,           &RowMeasurements::freedom};
}

/// The pixels about one edge, row by row (or a few neighbouring rows averaged), each made one number: how far
/// from the post's colour towards the background's, shading left out, in sigmas of the noise.
///
/// A column for each quantity: rows are worked on side by side, one in each lane of a vector.
struct EdgeRows {
    static constexpr std::size_t most_pairs = 20;
    static constexpr std::size_t block = 16;  // rows whose pixels stand together

    /// Of a block of rows, pair by pair, from the first of each row on.
    struct Pixels {
        using Values = std::array<std::array<float, block>, most_pairs>;
        alignas(64) Values value;
        alignas(64) Values stray;  // the same square to it: 0 with post and background alike
        alignas(64) Values luma;
    };

    std::size_t count = 0;
    std::vector<Pixels> pixels;
    RowColumn<float> pairs;   // of pixels; 0: too few inside the picture, or the background does not differ
    RowColumn<double> first;  // px, middle of the first pair; the next ones come 2 px further each
    RowColumn<double> column, row;               // px, where the edge was when the row was read
    RowColumn<double> ray_x, ray_y;              // its ray there (RowRay)
    RowColumn<double> slope_x, slope_y;          // and how that changes along the row
    RowColumn<float> other_edge;                 // what lies beyond the other edge, on the values' scale
    std::array<RowColumn<float>, 3> background;  // what lies outside, less the post's colour

    RowColumn<float> inner, outer;  // levels inside and outside, as the rows about it have them
    RowColumn<float> inner_variance,
        outer_variance;  // of the level in this row, were its own pixels not known

    // What lies farther in and out than `pixels`: mean value, pairs, and how many pairs next to the edge it
    // is worth as a level (far_levels.h).
    RowColumn<float> far_inner, far_outer;
    RowColumn<float> far_inner_pairs, far_outer_pairs;
    RowColumn<float> far_inner_weight, far_outer_weight;

    RowColumn<double> edge;  // px, where it was supposed last
    RowMeasurements measured;
    RowColumn<float> stray;     // as misfit, of the strays
    RowColumn<float> dark;      // px inside the edge that are black, in all, or as good as
    RowColumn<float> clean;     // 0…1, how far its pixels are those of one step
    RowColumn<float> weight;    // 0…1, of the row in the fit
    RowColumn<float> outvoted;  // 1: another place of the edge has more evidence (EdgeConsensus); else 0
    RowColumn<float> turn;      // px outwards for each rad of roll (SilhouetteStep)

    /// So many rows of which nothing is known.
    void assign(std::size_t rows);
    std::size_t blocks() const { return (count + block - 1) / block; }
    bool seen(std::size_t i) const { return pairs[i] > 0.0F; }
    /// Rows that can be judged.
    bool told(std::size_t i) const { return seen(i) && measured.information[i] > 0.0F; }
    double variance(std::size_t i) const {
        return 1.0 / static_cast<double>(measured.information[i]) + edge_roughness * edge_roughness;
    }
};

/// How rows of a picture are gathered.
struct RowLayout {
    static constexpr int most_averaged = 4;

    int first_row = 0;
    int last_row = 0;
    int bin = 1;         // neighbouring rows averaged
    double pitch = 1.0;  // px from one bin to the next
    int count = 0;       // bins
    double inner = 4.0;  // px to look inside an edge
    double outer = 6.0;  // and outside
    // The same for what tells levels alone:
    double far_inner = 12.0, far_outer = 12.0;

    /// The uppermost row of a bin.
    int top(int i) const { return nearest_whole(first_row + i * pitch); }
};

/// Rows for at most `most_rows` measurements of each edge between two rows. Of more rows than that up
/// to four neighbours are averaged, which keeps their information; of still more, some are left out.
RowLayout layout_rows(int first_row, int last_row, int most_rows);

}  // namespace goalmouth
