#pragma once

#include "core/extraction/candidates.h"
#include "core/geometry/camera.h"
#include "core/geometry/camera_pose.h"

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace goalmouth {

/// A line of sight against the vertical: azimuth [rad, + right of the camera's axis] about it, and slope, the
/// tangent of its elevation above level.
struct UprightRay {
    double azimuth = 0.0;
    double slope = 0.0;
};

/// A segment of a scan-line between its outer pixel borders.
struct UprightRun {
    UprightRay start, end;
    int row = -1;            // which of the picture's scan-lines
    bool cut_left = false;   // it begins at the picture's border
    bool cut_right = false;  // it ends there
};

struct UprightPoint {
    UprightRay ray;
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    int row = -1;  // which of the picture's scan-lines; −1: none
};

/// What a camera sees, turned so that the vertical is upright: there all of an upright post's edge has one
/// azimuth, whatever the camera's pitch and the lens. An error ρ of the vertical about the line of sight, a
/// post's lean or a rolling shutter's slant makes it azimuth + ρ·slope, to first order; an error within the
/// plane of sight shifts slopes.
class UprightView {
  public:
    /// `pose`: where the camera was, if that is known; else it is taken to stand level, with sigma
    /// `level_sigma` [rad]. Nothing where it looks along the vertical.
    static std::optional<UprightView> make(const Intrinsics& camera, const std::optional<CameraPose>& pose,
                                           double level_sigma);

    UprightRay ray(const Eigen::Vector2d& pixel) const;
    /// Nothing behind the camera.
    std::optional<Eigen::Vector2d> pixel(const UprightRay& ray) const;

    std::optional<double> height() const { return height_; }   // m, of the camera above the ground
    double attitude_sigma() const { return attitude_sigma_; }  // rad, about any level axis

  private:
    UprightView() = default;

    Intrinsics camera_;
    Eigen::Vector3d up_, ahead_, right_;  // frame C
    std::optional<double> height_;
    double attitude_sigma_ = 0.0;
};

/// The candidates of a frame as such a view has them.
class UprightCandidates {
  public:
    std::vector<UprightPoint> left, right;
    std::vector<UprightRun> runs;   // horizontal ones
    std::vector<UprightRun> field;  // where rows show the field
    std::vector<int> rows;          // px, the picture's horizontal scan-lines from top to bottom
    /// The field's border, upper convex hull of where rows show it, as a chain of (azimuth, slope) from left
    /// to right (chain_y_at). Empty where none do.
    std::vector<Eigen::Vector2d> border;

    /// Scan-lines without candidates are put where the others let expect them.
    void take(const Candidates& candidates, const UprightView& view);

  private:
    void find_border(const Candidates& candidates, const UprightView& view);
    void find_rows(const Candidates& candidates);

    std::vector<int> steps_, all_;
    std::vector<int> row_of_;  // by row of the picture
    std::vector<Eigen::Vector2d> field_ends_, hull_;
};

}  // namespace goalmouth
