#include "core/conversion/border.h"

#include "core/conversion/intrinsics.h"

namespace goalmouth {

border_t to_message(const FieldBorder& border, std::int64_t utime, std::int64_t seq,
                    const Intrinsics& camera) {
    border_t m{};
    m.utime = utime;
    m.seq = seq;
    m.intrinsics = to_message(camera);
    m.num_hull = static_cast<std::int32_t>(border.hull.size());
    for (const auto& p : border.hull) {
        m.hull_x.push_back(static_cast<float>(p.x()));
        m.hull_y.push_back(static_cast<float>(p.y()));
    }
    m.num_points = static_cast<std::int32_t>(border.points.size());
    for (const auto& p : border.points) {
        m.point_x.push_back(static_cast<float>(p.x()));
        m.point_y.push_back(static_cast<float>(p.y()));
    }
    return m;
}

FieldBorder from_message(const border_t& m) {
    FieldBorder border;
    for (std::size_t i = 0; i < m.hull_x.size(); ++i) border.hull.emplace_back(m.hull_x[i], m.hull_y[i]);
    for (std::size_t i = 0; i < m.point_x.size(); ++i) border.points.emplace_back(m.point_x[i], m.point_y[i]);
    return border;
}

}  // namespace goalmouth
