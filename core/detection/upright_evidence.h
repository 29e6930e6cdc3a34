#pragma once

#include "core/detection/upright_view.h"

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// The edges of an upright post: azimuth(slope) = left or right + roll · slope.
struct UprightEdges {
    double left = 0.0, right = 0.0;  // rad
    double roll = 0.0;               // rad

    /// Between the planes through both edges: across them, where azimuths count along the level.
    double half_angle() const { return 0.5 * (right - left) * std::cos(roll); }
    double middle(double slope) const { return 0.5 * (left + right) + roll * slope; }
};

/// What is known of a post before it is seen.
struct UprightSize {
    double radius = 0.05;  // m
    double height = 0.95;  // m, of the goal's upper edge
};

/// Rows agree for the same reason: what stands beside a post, or before it, does so in many of them. As many
/// are worth one draw, by which an error is as likely as its sigma says.
inline constexpr double rows_a_draw = 3.0;

/// What an error that far from nothing costs, in rows of evidence.
inline double cost_of_error(double error, double sigma) {
    if (error == 0.0) return 0.0;
    return rows_a_draw * 0.5 * (error / sigma) * (error / sigma);
}

/// What a frame's candidates say for a post with such edges.
struct UprightEvidence {
    double score = 0.0;  // sum over rows, less what errors of the pose cost
    double rows = 0.0;   // in the picture between the post's ends
    int left_rows = 0;   // of these, in which the edge is where it should be
    int right_rows = 0;
    int covered_rows = 0;                        // of the post's colour
    double first_slope = 0.0, last_slope = 0.0;  // of the uppermost and lowermost of these
};

/// Judges hypotheses by the rows a post of known size would be seen in.
///
/// Edges tell the distance, D = r / sin η, and that with the camera's height h and the goal's height H where
/// base and top are: at the slopes −h/(D − r) and (H − h)/(D ∓ r). An error of the measured vertical shifts
/// both; the shift is the one with most evidence, less its own cost. A row in between counts
///      2  its middle has the post's colour, and both edges are where they should be,
///      1  one edge alone is, and on the other side the colour goes on: something of the same stands there,
///    0.5  one edge alone is, and on the other side the colour ends too early: something may stand before
///         that edge, but as well the post may be a thinner one,
///   −0.3  the colour goes on on both sides,
///   −0.8  it has another colour: something stands before it, or it is no post,
///   −1.5  the same, above all that shows an edge: what stands on the field hides feet sooner than tops,
///     −3  besides, as far as the field shows between the edges: nothing hides the post there, there is none;
/// and one above or below the ends, where there is no post,
///   −0.75 for one edge, −5 for both where a post's would be, beside its colour: it is longer than posts are,
///   −0.3  below its base and above the field's border: a post does not hang over what lies behind the field.
///         Little, for a colour table that lacks the field's far part shows the border too low, and every
///         post hangs there.
/// The picture's border is no edge, and no missing one.
///
/// A post ends where its colour does, but for what stands before its foot: where the camera's height is
/// known, its edges go on to where it meets the ground, as far as no row shows field between them.
///
/// Where nobody knows the camera's height, a base does not lie deeper below the field's border than it could:
/// the border is below the horizon and the camera no higher than goals are, so by H / (D − r) at most; twice
/// that and 0.1 pass. (Where the height is known it says more than a border, which green walls raise.)
class UprightJudge {
  public:
    explicit UprightJudge(const UprightSize& size) : size_(size) {}

    UprightEvidence judge(const UprightCandidates& candidates, const UprightView& view,
                          const UprightEdges& edges, double tolerance);

  private:
    struct Row {
        double slope = 0.0;
        bool covered = false, left = false, right = false, cut = false;
        bool reaches_left = false, reaches_right = false;  // its colour does, or goes on beyond
        double field = 0.0;  // share of what lies between the edges, but for the tolerance
    };
    /// What the field's border says of a post's base, as slopes; without one, nothing.
    struct Horizon {
        double border = std::numeric_limits<double>::infinity();
        double deepest_base = -std::numeric_limits<double>::infinity();
    };
    Horizon horizon_of(const UprightCandidates& candidates, const UprightView& view,
                       const UprightEdges& edges, double distance) const;
    void look(const UprightCandidates& candidates, const UprightView& view, const UprightEdges& edges,
              double tolerance);

    UprightSize size_;
    std::vector<Row> rows_;
    std::vector<double> inside_, outside_;  // sums of rows' counts, before each row
};

}  // namespace goalmouth
