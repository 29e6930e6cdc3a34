#pragma once

#include "core/edges/edge_chains.h"
#include "core/edges/edge_parameters.h"
#include "core/edges/frame_edges.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace goalmouth {

/// A left and a right chain with one surface between them.
struct StripSeed {
    UprightLine left, right;
    int first_row = 0, last_row = 0;  // numbers of scan-lines
    Appearance inside;                // mean
    double contrast = 0.0;            // grey levels, as UprightStrip has it
    int rows = 0;                     // that show both edges
};

/// Finds pairs of chains that may be a strip: as wide and as parallel as posts are, seen together on most of
/// at least `least_rows` rows, in most of which the surfaces just inside the two edges look alike and nothing
/// between them stands out as they do.
///
/// Pairs are met on the rows: from each edge of a left chain to the right, until something stands out that no
/// right edge is distinct enough for. What lies between two edges of a pair is fainter than they are, so an
/// edge has few others on a row, however many chains there are (chequerboards, fences, stands).
class StripSeedFinder {
  public:
    explicit StripSeedFinder(const StripParameters& parameters) : parameters_(parameters) {}

    /// From the most to the least distinct. `width`: px of the picture. Valid until the next call.
    const std::vector<StripSeed>& find(const FrameEdges& frame, std::span<const EdgeChain> left,
                                       std::span<const EdgeChain> right, float chroma_weight,
                                       double straightness, int width);

    /// How many edges were looked at for the latest frame, each time counted.
    std::size_t looks() const { return looks_; }

  private:
    void meet(std::size_t row, std::size_t left);
    std::optional<StripSeed> seed(const EdgeChain& left, const EdgeChain& right, int whole);
    double unlike(const Appearance& a, const Appearance& surface, float shade) const;
    double from_left(std::size_t edge);
    double from_right(std::size_t edge);

    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    StripParameters parameters_;
    const FrameEdges* frame_ = nullptr;
    float chroma_weight_ = 0.F;
    double straightness_ = 0.0;
    double narrowest_ = 0.0, widest_ = 0.0;  // px
    std::size_t looks_ = 0;
    // Of each edge: how unlike its sides look, seen from the one or the other, where that was asked.
    std::vector<float> from_left_, from_right_;
    std::vector<std::size_t> right_chain_;  // of each edge; or none
    std::vector<int> met_;                 // of each right chain: rows on which the left one in work meets it
    std::vector<std::size_t> candidates_;  // right chains that it meets
    std::vector<StripSeed> seeds_;
};

}  // namespace goalmouth
