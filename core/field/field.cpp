#include "core/field/field.h"

namespace goalmouth {

std::array<Eigen::Vector2d, 4> Field::posts() const {
    const double x = length / 2.0;
    const double y = goal_width / 2.0;
    return {Eigen::Vector2d(-x, y), Eigen::Vector2d(-x, -y), Eigen::Vector2d(x, y), Eigen::Vector2d(x, -y)};
}

}  // namespace goalmouth
