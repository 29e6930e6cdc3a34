#include "core/detection/edge_lines.h"

namespace goalmouth {
namespace {

template <class Points>
EdgeLine supported(const Line& line, const Points& consensus) {
    return {segment_on_line(line, consensus), static_cast<int>(consensus.size()),
            rms_distance(line, consensus)};
}

}  // namespace

EdgeLine edge_line(const Line& line, std::span<const Eigen::Vector2d> consensus) {
    return supported(line, consensus);
}

EdgeLine edge_line(const Line& line, const PointColumns& consensus) {
    return supported(line, consensus);
}

}  // namespace goalmouth
