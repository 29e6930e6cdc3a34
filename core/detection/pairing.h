#pragma once

#include "core/detection/edge_lines.h"
#include "core/extraction/candidates.h"
#include "core/parameters/parameters.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace goalmouth {

/// Rules that tie a left and a right edge line together into a post.
struct PairingParameters {
    double permissiveness = 0.2;
    bool left_of = true;
    double least_aspect = 1.5;
    double nearest = 0.2;
    double farthest = 10.0;
    double cut_margin = 0.0;
    double largest_hole = 1.0;
    double largest_lean = 1.5708;
};

template <class Visitor>
void describe_parameters(Visitor& v, PairingParameters& p) {
    v("permissiveness", p.permissiveness, Range{0, 1}, "1",
      "ρ: how unlike the two edges of a post may be in angle, length, place and support (the 2013 robot "
      "code: 0.2)");
    v("left_of", p.left_of, "the left edge must lie left of the right edge (2013 robot code)");
    v("least_aspect", p.least_aspect, Range{0, 1000}, "1",
      "least length of a post over its width (2013 robot code: 1.5); 0: any");
    v("nearest", p.nearest, Range{0, 1000}, "m",
      "nearest plausible distance by width (ours; the 2013 robot code had such a bound)");
    v("farthest", p.farthest, Range{0, 1000}, "m",
      "farthest plausible distance by width (ours); 0: any distance passes");
    v("cut_margin", p.cut_margin, at_least(0), "px",
      "edges that end nearer than this to the image's left or right border are compared over the rows both "
      "have (ours); 0: as any other");
    v("largest_hole", p.largest_hole, Range{0, 1}, "1",
      "longest stretch of a post without the post's colour, as a share of its length (ours); 1: any");
    v("largest_lean", p.largest_lean, Range{0, 1.5708}, "rad",
      "how far a post may lean from the image's vertical (ours: else a crossbar passes for a post); 1.5708: "
      "any way");
}

/// Two edge lines measured against each other (paper, section 4). Each value is accepted while it is below
/// its bound.
struct PairMeasures {
    double angle = 0.0;              // rad, acute
    double angle_bound = 0.0;        // ρ · π/2
    double length_difference = 0.0;  // px
    double length_bound = 0.0;       // ρ · max(ℓ₁, ℓ₂)
    double endpoint_distance = 0.0;  // px, (d₁ + d₂) / 2
    double endpoint_bound = 0.0;     // ρ · √(w² + h²); the text's √(w² + h^h) is a misprint
    int support_difference = 0;
    double support_bound = 0.0;  // ρ · max(n₁, n₂)
    double width = 0.0;   // px across the mean direction, at the middle; negative: the left edge lies right
    double length = 0.0;  // px, mean of the two
    double lean = 0.0;    // rad, of the mean direction from the image's vertical, 0…π/2

    bool similar() const {
        return angle < angle_bound && length_difference < length_bound &&
               endpoint_distance < endpoint_bound && support_difference < support_bound;
    }
    /// Mean of the four values over their bounds: 0 for twins, below 1 for every similar pair.
    double dissimilarity() const;
};

PairMeasures compare_edges(const EdgeLine& left, const EdgeLine& right, int image_width, int image_height,
                           double permissiveness);

/// Signed distance from the left to the right line across their mean direction [px], measured at the middle
/// of their four end points; an image's post has one width whatever its lean.
double width_across(const LineSegment& left, const LineSegment& right);

/// Numbers of a left and a right edge line that make a post.
struct EdgePair {
    std::size_t left;
    std::size_t right;
};

/// The edges over the rows that both have, where the image's left or right border cuts one of them to within
/// `margin` px of its end; support shrinks with the length. Otherwise as they are. Both keep their lines.
std::pair<EdgeLine, EdgeLine> common_rows(const EdgeLine& left, const EdgeLine& right, int image_width,
                                          double margin);

/// Longest stretch of rows between two edges, as a share of their common rows, in which no candidate segment
/// covers half of the width between them. 1 for edges without common rows.
double largest_hole(const LineSegment& left, const LineSegment& right, const Candidates& candidates);

/// The same with memory to work in.
double largest_hole(const LineSegment& left, const LineSegment& right, const Candidates& candidates,
                    std::vector<double>& covered);

/// The pairs of edges that satisfy the paper's four conditions and, as far as switched on, the rules of the
/// authors' 2013 robot code and ours. `candidates` are what the edges were found among.
/// `width_times_distance` [px·m] is γ_x times the post's diameter: a pair's distance is this over its width.
///
/// The text collects every pair that passes. An edge has but one post, though, so a line is used once: pairs
/// are taken in the order of their dissimilarity, the most alike first, as long as both lines are free.
class EdgePairing {
  public:
    explicit EdgePairing(const PairingParameters& parameters) : parameters_(parameters) {}

    /// Valid until the next call. No heap allocation once warm.
    const std::vector<EdgePair>& pair(const std::vector<EdgeLine>& left, const std::vector<EdgeLine>& right,
                                      const Candidates& candidates, double width_times_distance);

  private:
    struct Scored {
        EdgePair pair;
        double dissimilarity;
    };

    PairingParameters parameters_;
    std::vector<Scored> acceptable_;
    std::vector<double> covered_;
    std::vector<EdgePair> pairs_;
};

/// An EdgePairing used once.
std::vector<EdgePair> pair_edges(const std::vector<EdgeLine>& left, const std::vector<EdgeLine>& right,
                                 const Candidates& candidates, double width_times_distance,
                                 const PairingParameters& parameters);

}  // namespace goalmouth
