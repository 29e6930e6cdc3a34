#include "core/detection/edge_lines.h"

#include <cmath>

namespace goalmouth {
namespace {

template <class Points>
EdgeLine supported(const Line& line, const Points& consensus) {
    double squares = 0.0;
    for (std::size_t i = 0; i < consensus.size(); ++i) {
        const double distance = line.signed_distance(consensus[i]);
        squares += distance * distance;
    }
    const double count = static_cast<double>(consensus.size());
    return {segment_on_line(line, consensus), static_cast<int>(consensus.size()), std::sqrt(squares / count)};
}

}  // namespace

EdgeLine edge_line(const Line& line, std::span<const Eigen::Vector2d> consensus) {
    return supported(line, consensus);
}

EdgeLine edge_line(const Line& line, const PointColumns& consensus) {
    return supported(line, consensus);
}

}  // namespace goalmouth
