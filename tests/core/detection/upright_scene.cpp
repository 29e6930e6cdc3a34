#include "tests/core/detection/upright_scene.h"

#include "core/detection/upright_detector.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth::test {

Cylinder post_at(double ahead, double left, double top, double radius) {
    return {{ahead, left, 0.0}, Eigen::Vector3d::UnitZ(), top, radius};
}

Candidates empty_frame(const Intrinsics& camera) {
    Candidates c;
    c.width = camera.width;
    c.height = camera.height;
    return c;
}

void add(Candidates& c, const Robot& robot, const Cylinder& thing, const Change& change) {
    const auto edges = project_edges(robot.camera, robot.T_BC(), thing);
    ASSERT_TRUE(edges);
    const auto x_at = [](const Eigen::Vector2d& top, const Eigen::Vector2d& base, double y) {
        return top.x() + (y - top.y()) / (base.y() - top.y()) * (base.x() - top.x());
    };
    const double top = std::max(edges->left_top.y(), edges->right_top.y());
    const double base = std::min(edges->left_base.y(), edges->right_base.y());
    for (int y = 2; y < c.height; y += spacing) {
        if (y < top || y > base) continue;
        Row row{x_at(edges->left_top, edges->left_base, y), x_at(edges->right_top, edges->right_base, y)};
        if (change) change(row, (y - top) / (base - top));
        const int first = static_cast<int>(std::ceil(std::max(row.left, -0.5)));
        const int last = static_cast<int>(std::floor(std::min(row.right, c.width - 0.5)));
        if (!row.shows || last < first) continue;
        c.segments.push_back({Orientation::horizontal, y, first, last});
        if (row.left_edge && row.left > -0.5) c.left_edges.emplace_back(row.left, y);
        if (row.right_edge && row.right < c.width - 0.5) c.right_edges.emplace_back(row.right, y);
    }
}

std::vector<Post> detect(const Candidates& c, const Robot& robot, const std::optional<CameraPose>& pose) {
    return UprightDetector({}, Field{}).detect(c, robot.camera, pose);
}

}  // namespace goalmouth::test
