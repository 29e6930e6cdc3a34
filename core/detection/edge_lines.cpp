#include "core/detection/edge_lines.h"

#include <cmath>

namespace goalmouth {

EdgeLine edge_line(const Line& line, std::span<const Eigen::Vector2d> consensus) {
    double squares = 0.0;
    for (const auto& p : consensus) {
        const double distance = line.signed_distance(p);
        squares += distance * distance;
    }
    const double count = static_cast<double>(consensus.size());
    return {segment_on_line(line, consensus), static_cast<int>(consensus.size()), std::sqrt(squares / count)};
}

}  // namespace goalmouth
