#pragma once

#include "core/geometry/camera.h"
#include "core/parameters/parameters.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace goalmouth {

/// Which rows and columns of the image are looked at (paper, section 2, step 1), each ascending and without
/// repetition.
struct ScanLayout {
    std::vector<int> rows;     // px, y of the horizontal scan-lines
    std::vector<int> columns;  // px, x of the vertical scan-lines
};

struct ScanLineParameters {
    std::string spacing = "image";
    int row_spacing = 4;
    int column_spacing = 4;
    double field_spacing = 0.05;
    double column_distance = 3.0;
    int largest_spacing = 32;
};

template <class Visitor>
void describe_parameters(Visitor& v, ScanLineParameters& p) {
    v("spacing", p.spacing, Choice{"image", "field"},
      "where scan-lines are equidistant: in the image, or on the field plane");
    v("row_spacing", p.row_spacing, Range{1, 1024}, "px",
      "from one horizontal scan-line to the next (the 2013 robot code: 4)");
    v("column_spacing", p.column_spacing, Range{1, 1024}, "px",
      "from one vertical scan-line to the next (the 2013 robot code: 4)");
    v("field_spacing", p.field_spacing, Range{0.005, 2}, "m",
      "spacing field: from one scan-line to the next on the ground");
    v("column_distance", p.column_distance, Range{0.2, 50}, "m",
      "spacing field: distance at which vertical scan-lines are field_spacing apart");
    v("largest_spacing", p.largest_spacing, Range{1, 1024}, "px",
      "spacing field: never farther apart than this");
}

/// Equidistant in the image: the first line stands half a spacing from the border. Every image has at least
/// one row and one column.
ScanLayout image_layout(int width, int height, const ScanLineParameters& parameters);

/// Equidistant on the field plane, seen by a camera at T_BC (frame B: z = 0 is the ground).
///
/// Rows: from the image's lower end upwards, the next row that sees ground field_spacing farther away along
/// the middle column, but never closer than row_spacing nor farther than largest_spacing; above the horizon
/// they go on at row_spacing, because a post stands up above its foot. Columns: a constant spacing,
/// field_spacing at column_distance, within column_spacing and largest_spacing. With a rolled camera rows are
/// equidistant along the middle column only.
///
/// Without a camera pose, and where the lower end of the middle column sees no ground, the answer is
/// image_layout().
ScanLayout field_layout(const Intrinsics& camera, const std::optional<Eigen::Isometry3d>& T_BC,
                        const ScanLineParameters& parameters);

/// The layout that `parameters.spacing` asks for.
ScanLayout scan_layout(const Intrinsics& camera, const std::optional<Eigen::Isometry3d>& T_BC,
                       const ScanLineParameters& parameters);

/// scan_layout() from frame to frame: computed again only where the camera changed, or the pose of a camera
/// whose lines are equidistant on the field.
class LatestScanLayout {
  public:
    explicit LatestScanLayout(ScanLineParameters parameters) : parameters_(std::move(parameters)) {}

    /// Valid until the next call.
    const ScanLayout& at(const Intrinsics& camera, const std::optional<Eigen::Isometry3d>& T_BC);

  private:
    ScanLineParameters parameters_;
    bool known_ = false;
    Intrinsics camera_;
    std::optional<Eigen::Isometry3d> T_BC_;
    ScanLayout layout_;
};

}  // namespace goalmouth
