#include "core/conversion/intrinsics.h"

#include <algorithm>

namespace goalmouth {

intrinsics_t to_message(const Intrinsics& camera) {
    intrinsics_t m{};
    m.width = camera.width;
    m.height = camera.height;
    m.fx = camera.fx;
    m.fy = camera.fy;
    m.cx = camera.cx;
    m.cy = camera.cy;
    std::copy(camera.distortion.begin(), camera.distortion.end(), m.distortion);
    return m;
}

Intrinsics from_message(const intrinsics_t& m) {
    Intrinsics camera;
    camera.width = m.width;
    camera.height = m.height;
    camera.fx = m.fx;
    camera.fy = m.fy;
    camera.cx = m.cx;
    camera.cy = m.cy;
    std::copy(std::begin(m.distortion), std::end(m.distortion), camera.distortion.begin());
    return camera;
}

}  // namespace goalmouth
