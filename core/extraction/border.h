#pragma once

#include "core/parameters/parameters.h"
#include "core/segmentation/segments.h"

#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// Field border in the image [px] (paper, section 2, step 2).
struct FieldBorder {
    std::vector<Eigen::Vector2d> hull;    // upper convex hull, left to right; empty: no field in view
    std::vector<Eigen::Vector2d> points;  // tops of the green runs it was made of

    /// y of the border at image column x; beyond the hull's ends, the y of the nearer end. Requires a hull.
    double y_at(double x) const;
    bool empty() const { return hull.empty(); }
};

struct BorderParameters {
    int green_run = 5;
};

template <class Visitor>
void describe_parameters(Visitor& v, BorderParameters& p) {
    v("green_run", p.green_run, Range{1, 16384}, "px",
      "consecutive pixels of the field's colour that make a column's field begin (the 2013 robot code: 5)");
}

/// The border of the field: on each vertical scan-line, from the top, the first run of at least green_run
/// pixels of the field's colour gives a point, its uppermost pixel; the border is the upper convex hull of
/// these points. Columns without such a run give none. The 2013 robot code looked at every 11th column; here
/// every vertical scan-line takes part.
class BorderFinder {
  public:
    explicit BorderFinder(const BorderParameters& parameters) : parameters_(parameters) {}

    /// Valid until the next call. No heap allocation once warm.
    const FieldBorder& find(const Segments& segments);

  private:
    BorderParameters parameters_;
    FieldBorder border_;
    std::vector<Eigen::Vector2d> sorted_;
};

/// The border of one frame: a BorderFinder used once.
FieldBorder find_border(const Segments& segments, const BorderParameters& parameters);

}  // namespace goalmouth
