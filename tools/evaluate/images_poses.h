#pragma once

#include "core/geometry/pose2.h"

#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// Where a robot stood and how it held its head as it took a picture.
struct RobotPlace {
    Pose2 feet;               // on the field, frame W [m, rad]
    double head_yaw = 0.0;    // rad, + left of the body's heading
    double head_pitch = 0.0;  // rad, as the robot counts it

    double looks() const { return wrap_angle(feet.theta + head_yaw); }  // direction in frame W, rad
};

/// Reads a robot's place in a picture's file name.
///
/// A pattern is the name, without folder and extension, with pieces of it in braces:
///   {NAME_UNIT}  a number; NAME is x, y (UNIT m, cm, mm), heading, head_yaw or head_pitch (deg, rad)
///   {}           anything, but none of the characters that stand beside it in the pattern
/// x, y and heading must be there, an angle of the head that is not is 0. Between two pieces there must be
/// something, else nobody could tell where one ends.
class PlacePattern {
  public:
    /// Throws ConfigurationError, which says what would be valid.
    explicit PlacePattern(const std::string& text);

    /// `file`: a path or a name, with its ending. Nothing where it does not fit.
    std::optional<RobotPlace> place(const std::string& file) const;
    /// A name that fits: "000001_12.5_…".
    std::string example() const;
    const std::string& text() const { return text_; }

  private:
    struct Piece {
        std::string literal;             // before the braces
        std::string other_than;          // characters that {} does not take
        double RobotPlace::*angle = {};  // where the number goes: here,
        double Pose2::*coordinate = {};  // or there, or nowhere
        double unit = 0.0;               // in m or rad; 0: {}
    };
    void add_piece(const std::string& literal, const std::string& inside);

    std::string text_;
    std::vector<Piece> pieces_;
    std::string end_;  // behind the last one
};

}  // namespace goalmouth
