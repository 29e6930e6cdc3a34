#include "core/refinement/crossing_curve.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

/// How far the curve lies off the pixel whose ray lies in the plane, at most [px].
double worst_miss(const Intrinsics& camera, const Eigen::Vector3d& plane, double x_near) {
    CrossingCurve curve;
    const double last = camera.height - 1.0;
    curve.follow(camera, plane, x_near, 0.0, last);
    double worst = 0.0;
    for (double row = 0.0; row <= last; row += 3.7) {
        const RowRay here = curve.at(row);
        if (here.x < 0.0 || here.x > camera.width - 1.0) continue;
        // The exact crossing, by bisection.
        const auto side = [&](double x) {
            const Eigen::Vector2d n = normalised_from_pixel(camera, {x, row});
            return plane.dot(Eigen::Vector3d(n.x(), n.y(), 1.0));
        };
        double left = here.x - 2.0, right = here.x + 2.0;
        const bool rises = side(right) > 0.0;
        for (int i = 0; i < 50; ++i) {
            const double middle = 0.5 * (left + right);
            ((side(middle) > 0.0) == rises ? right : left) = middle;
        }
        worst = std::max(worst, std::abs(here.x - left));
        // And the ray is that pixel's, its slope how it changes.
        const Eigen::Vector2d n = normalised_from_pixel(camera, {here.x, row});
        worst = std::max(worst, camera.fx * (n - here.ray.head<2>()).norm());
        const Eigen::Vector2d next = normalised_from_pixel(camera, {here.x + 1.0, row});
        EXPECT_NEAR((next - n).x() / here.slope.x(), 1.0, 2e-3);
    }
    return worst;
}

TEST(CrossingCurve, FollowsUsualLensesToAThousandthOfAPixel) {
    const std::array<std::array<double, 5>, 4> lenses = {{{-0.09, 0.0, 0.0, 0.0, 0.0},
                                                          {-0.35, 0.12, 0.001, -0.0015, 0.0},
                                                          {0.1, -0.2, 0.0, 0.002, 0.05},
                                                          {0.0, 0.0, 0.0, 0.0, 0.0}}};
    for (const auto& lens : lenses) {
        for (const int width : {640, 1600}) {
            Intrinsics camera;
            camera.distortion = lens;
            camera = scaled_to(camera, width, width * 3 / 4);
            for (const double at : {-0.4, 0.02, 0.45}) {
                for (const double slant : {-0.35, 0.0, 0.2}) {
                    const Eigen::Vector3d plane = Eigen::Vector3d(1.0, slant, -at).normalized();
                    EXPECT_LT(worst_miss(camera, plane, camera.cx + camera.fx * at), 1e-3)
                        << lens[0] << " " << width << " " << at << " " << slant;
                }
            }
        }
    }
}

TEST(CrossingCurve, APlaneAlongTheRowsCrossesNone) {
    CrossingCurve curve;
    curve.follow(Intrinsics{}, Eigen::Vector3d::UnitY(), 100.0, 10.0, 20.0);
    EXPECT_FALSE(std::isfinite(curve.at(15.0).x));
}

}  // namespace
}  // namespace goalmouth
