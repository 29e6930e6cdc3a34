#pragma once

#include "core/edges/appearance.h"
#include "core/edges/edge_parameters.h"
#include "core/edges/frame_edges.h"
#include "core/edges/upright_line.h"

#include <cstddef>
#include <span>
#include <vector>

namespace goalmouth {

/// Which edge of a post a chain may be. The post lies to the right of a left edge and to the left of a right
/// one: polarity, in colour as well as in brightness.
enum class ChainSide { left, right };

inline const Appearance& inside_of(const RowEdge& edge, ChainSide side) {
    return side == ChainSide::left ? edge.right : edge.left;
}

struct ChainPoint {
    int row = 0;           // number of the horizontal scan-line
    std::size_t edge = 0;  // number of its edge in FrameEdges
};

/// Edges of successive rows on one straight line, with one surface on the post's side of them.
struct EdgeChain {
    std::vector<ChainPoint> points;  // by row, no row twice
    UprightLine line;                // through them
};

/// Follows edges down the rows.
///
/// What continues a chain lies where its latest points lead to, within `straightness`, and shows on the
/// post's side the surface seen so far, while the background may change as it likes: a post stands before
/// what there is. A chain too short to lead anywhere may miss no row. An edge may belong to a left and to a
/// right chain. Chains of fewer than `least_rows` edges on their line are dropped.
class ChainFinder {
  public:
    explicit ChainFinder(const StripParameters& parameters) : parameters_(parameters) {}

    /// `darkest`: luma of the darkest surface a chain may begin with. Valid until the next call. No heap
    /// allocation once warm.
    std::span<const EdgeChain> find(const FrameEdges& frame, ChainSide side, const EdgeThreshold& threshold,
                                    double straightness, float darkest);

  private:
    /// A point of a chain in the making, and its neighbours in it.
    struct Link {
        ChainPoint point;
        std::size_t before = 0, after = 0;
    };
    struct Track {
        std::size_t last = 0;    // number of its last link
        std::size_t oldest = 0;  // and of the oldest one that leads on
        std::size_t points = 0;
        UprightFit latest;  // points
        UprightLine ahead;  // where they lead
        int last_row = 0;
        Appearance inside;  // mean, the latest counting more
    };
    const RowEdge* next_edge(std::span<const RowEdge> edges, const Track& track, double x,
                             double tolerance) const;
    void begin_chains(std::size_t row);
    void extend(Track& track, std::size_t row, std::size_t edge);
    void end(const Track& track);
    void lead_on(Track& track);
    std::size_t straighten();
    double x_of(const Link& link) const;

    StripParameters parameters_;
    const FrameEdges* frame_ = nullptr;
    ChainSide side_ = ChainSide::left;
    float chroma_weight_ = 0.F;
    double straightness_ = 0.0;
    float darkest_ = 0.F;
    std::vector<Link> links_;
    std::vector<EdgeChain> chains_;  // the first count_ are in use
    std::size_t count_ = 0;
    std::vector<Track> tracks_;
    std::vector<double> places_;  // x of the edges of the row in work
    std::vector<char> claimed_;   // and which continue a chain
};

}  // namespace goalmouth
