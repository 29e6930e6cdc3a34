#include "core/detection/edge_lines.h"

#include <cmath>

namespace goalmouth {

EdgeLine edge_line(const Line& line, std::span<const Eigen::Vector2d> consensus) {
    return {segment_on_line(line, consensus), static_cast<int>(consensus.size()),
            std::sqrt(mean_square_distance(line, consensus))};
}

}  // namespace goalmouth
