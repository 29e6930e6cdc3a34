#pragma once

#include "core/refinement/edge_rows.h"
#include "core/refinement/post_colour.h"

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// Bytes Y0 Cb Y1 Cr of pairs of pixels, lowest first, for a block of rows: the pairs that EdgeRows holds,
/// one before them and one behind.
struct RawPairs {
    static constexpr std::size_t most = EdgeRows::most_pairs + 2, together = 4;
    static constexpr std::size_t room = (most + together - 1) / together * together;
    using Rows = std::array<std::array<std::uint32_t, EdgeRows::block>, room>;
    alignas(64) std::array<Rows, RowLayout::most_averaged> bins{};  // of each of the rows averaged
};

/// What lies well outside the edge in each row: sums over pairs.
struct BackgroundSums {
    std::array<RowColumn<float>, 3> colour;  // less the post's
    RowColumn<float> pairs;
};

/// What makes a number of a colour in a row.
struct RowWeights {
    std::array<RowColumn<float>, 3> along, square;  // of `value` and `stray`
};

/// The first pairs of a block of rows from where each of them begins; `together` of them are read at once,
/// past the last one as well.
void lay_out(const std::array<const std::uint8_t*, EdgeRows::block>& from, std::size_t pairs,
             RawPairs::Rows& raw);

/// Colours less the post's of a block of rows, as the mean of `bin` rows, into `value`, `stray` and `luma`;
/// and the sums of those whose middle lies `clear` px or more outside the edge. `start`: px of each row's
/// first pair outwards from the edge.
void read_pairs(const RawPairs& raw, int bin, const PostColour& colour, std::size_t block, float outwards,
                float clear, const RowColumn<float>& start, EdgeRows& rows, BackgroundSums& background);

/// The background as each row and `reach` rows to either side have it: their sums over their pairs.
void spread_background(const BackgroundSums& sums, std::size_t rows, std::size_t reach,
                       std::array<RowColumn<float>, 3>& background);

/// How to tell post from background in each row. Rows whose contrast is less than `least` squared are no
/// longer seen. `own` and `other`: backgrounds on this side and beyond the other edge.
void weigh_colours(const Eigen::Matrix3f& contrast, const Eigen::Vector3f& shade, float gain, float least,
                   const std::array<RowColumn<float>, 3>& own, const std::array<RowColumn<float>, 3>& other,
                   EdgeRows& rows, RowWeights& weights);

/// Colours into values, strays and lumas.
void project_pairs(const RowWeights& weights, float luma, EdgeRows& rows);

}  // namespace goalmouth
