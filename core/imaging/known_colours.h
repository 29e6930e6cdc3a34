#pragma once

#include <optional>

#include <Eigen/Core>

namespace goalmouth {

/// What two things look like in the light that a colour table was made in: red, green, blue [levels]. The
/// table alone says which colours it takes for them, not which of those occur. Nothing where nobody has seen
/// them yet.
struct KnownColours {
    std::optional<Eigen::Vector3d> field;  // the carpet
    std::optional<Eigen::Vector3d> goal;   // goalposts
    bool operator==(const KnownColours&) const = default;
};

}  // namespace goalmouth
