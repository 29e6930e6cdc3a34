#include "core/imaging/colour_gains.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/LU>

namespace goalmouth {

namespace {

/// (R, G, B) of (Y, Cb − 128, Cr − 128): ITU-R BT.601, full range.
Eigen::Matrix3d rgb_of_ycbcr() {
    Eigen::Matrix3d m;
    m << 1.0, 0.0, 1.402,           //
        1.0, -0.344136, -0.714136,  //
        1.0, 1.772, 0.0;
    return m;
}

std::uint8_t level(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

}  // namespace

ColourTable adapted(const ColourTable& base, const ColourGains& gains) {
    if (gains == ColourGains{}) return base;
    const Eigen::Matrix3d to_rgb = rgb_of_ycbcr();
    const Eigen::Vector3d undo(1.0 / gains.red, 1.0 / gains.green, 1.0 / gains.blue);
    const Eigen::Matrix3d back = to_rgb.inverse() * undo.asDiagonal() * to_rgb;
    ColourTable table(base.bits(), base.name());
    for (const std::string& line : base.provenance()) table.add_provenance(line);
    const int step = 1 << (8 - base.bits());
    const double centre = 0.5 * (step - 1);
    std::size_t entry = 0;
    for (int cb = 0; cb < 256; cb += step) {
        for (int cr = 0; cr < 256; cr += step) {
            const Eigen::Vector3d chroma =
                back * Eigen::Vector3d(0.0, cb + centre - 128.0, cr + centre - 128.0);
            for (int y = 0; y < 256; y += step, ++entry) {
                const Eigen::Vector3d was = chroma + back.col(0) * (y + centre);
                table.entries()[entry] = static_cast<std::uint8_t>(
                    base.at({level(was[0]), level(was[1] + 128.0), level(was[2] + 128.0)}));
            }
        }
    }
    return table;
}

}  // namespace goalmouth
