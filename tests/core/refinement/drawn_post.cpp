#include "tests/core/refinement/drawn_post.h"

#include "core/random/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth::test {
namespace {

constexpr int across = 4, down = 2;  // pieces of a pixel

void blur_line(std::vector<Levels>& line, double sigma) {
    const int reach = static_cast<int>(std::ceil(4.0 * sigma));
    std::vector<double> kernel;
    double sum = 0.0;
    for (int k = -reach; k <= reach; ++k)
        sum += kernel.emplace_back(std::exp(-0.5 * k * k / (sigma * sigma)));
    const std::vector<Levels> sharp = line;
    const int last = static_cast<int>(line.size()) - 1;
    for (int i = 0; i <= last; ++i) {
        Levels level = Levels::Zero();
        for (int k = -reach; k <= reach; ++k)
            level += kernel[static_cast<std::size_t>(k + reach)] *
                     sharp[static_cast<std::size_t>(std::clamp(i + k, 0, last))];
        line[static_cast<std::size_t>(i)] = level / sum;
    }
}

/// Share of a piece on the positive side of a plane; `reach`: change of plane·ray over the piece.
double share_inside(double value, double reach) {
    return std::clamp(value / std::max(std::abs(reach), 1e-12) + 0.5, 0.0, 1.0);
}

/// IEC 61966-2-1.
double level_of(double light) {
    const double l = std::clamp(light / 255.0, 0.0, 1.0);
    return 255.0 * (l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055);
}

std::uint8_t byte(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

}  // namespace

Cylinder DrawnPost::cylinder() const {
    Cylinder result;
    result.base = {distance * std::cos(bearing), distance * std::sin(bearing), 0.0};
    result.length = length;
    result.radius = radius;
    return result;
}

CameraPose DrawnPost::pose(double sigma) const {
    CameraPose result;
    result.T_BC = T_WC();
    result.covariance = sigma * sigma * Eigen::Matrix<double, 6, 6>::Identity();
    return result;
}

YuyvImage DrawnPost::draw() const {
    const Cylinder post_cylinder = cylinder();
    const auto outline = silhouette(post_cylinder, T_WC());
    const Eigen::Matrix3d R_CW = T_WC().linear().transpose();
    const Eigen::Vector3d up = R_CW.col(2);
    const Eigen::Vector3d ahead = R_CW * Eigen::Vector3d(std::cos(bearing), std::sin(bearing), 0.0);
    const Eigen::Vector3d aside = up.cross(ahead);  // to the left
    YuyvImage image(camera.width, camera.height);
    const auto width = static_cast<std::size_t>(camera.width), rows = static_cast<std::size_t>(camera.height);
    const auto fine_width = width * across, fine_rows = rows * down;
    std::vector<std::vector<Levels>> fine(fine_rows, std::vector<Levels>(fine_width));
    const bool bent = camera.has_distortion();
    for (std::size_t v = 0; v < fine_rows; ++v) {
        const double y = (static_cast<double>(v) + 0.5) / down - 0.5;
        for (std::size_t u = 0; u < fine_width; ++u) {
            const double x = (static_cast<double>(u) + 0.5) / across - 0.5;
            Levels level = behind ? behind(x, y) : Levels(150, 150, 155);
            const Eigen::Vector2d point =
                bent ? normalised_from_pixel(camera, {x, y})
                     : Eigen::Vector2d((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy);
            const Eigen::Vector3d ray = point.homogeneous();
            const double forward = ray.dot(ahead);
            if (outline && forward > 0.0) {
                const double slope = ray.dot(up) / forward;
                const double at = height + slope * distance;
                const double step = distance / (camera.fy * down);
                const double share = share_inside(outline->left_plane.dot(ray),
                                                  outline->left_plane.x() / (camera.fx * across)) *
                                     share_inside(outline->right_plane.dot(ray),
                                                  outline->right_plane.x() / (camera.fx * across)) *
                                     share_inside(at, step) * share_inside(length - at, step);
                if (share > 0.0) {
                    const double sine = std::clamp(
                        ray.dot(aside) / std::hypot(ray.dot(aside), forward) / std::sin(outline->half_angle),
                        -1.0, 1.0);
                    const double light = 1.0 - limb_darkening * (1.0 - std::sqrt(1.0 - sine * sine));
                    level += share * (light * post - level);
                }
            }
            if (before)
                if (const auto front = before(x, y)) level = *front;
            fine[v][u] = level;
        }
        if (blur > 0.0) blur_line(fine[v], blur * across);
    }
    Random random(seed);
    std::vector<Levels> column(fine_rows);
    std::vector<Levels> pixels(width * rows, Levels::Zero());
    for (std::size_t u = 0; u < fine_width; ++u) {
        for (std::size_t v = 0; v < fine_rows; ++v) column[v] = fine[v][u];
        if (blur > 0.0) blur_line(column, blur * down);
        for (std::size_t v = 0; v < fine_rows; ++v)
            pixels[v / down * width + u / across] += column[v] / (across * down);
    }
    for (std::size_t y = 0; y < rows; ++y) {
        std::uint8_t* out = image.data.data() + y * static_cast<std::size_t>(image.stride());
        for (std::size_t x = 0; x < width; x += 2) {
            double cb = 0.0, cr = 0.0;
            for (std::size_t k = 0; k < 2; ++k) {
                Levels p = pixels[y * width + std::min(x + k, width - 1)];
                if (coded) p = p.unaryExpr(&level_of);
                for (int c = 0; c < 3; ++c) p[c] = std::clamp(p[c] + noise * random.normal(), 0.0, 255.0);
                const double luma = p.dot(Levels(0.299, 0.587, 0.114));
                out[2 * x + 2 * k] = byte(luma + black);
                cb += 0.5 * (p[2] - luma) / 1.772;
                cr += 0.5 * (p[0] - luma) / 1.402;
            }
            out[2 * x + 1] = byte(cb + 128.0);
            out[2 * x + 3] = byte(cr + 128.0);
        }
    }
    return image;
}

Post DrawnPost::found(double left_moved, double right_moved) const {
    const auto edges = project_edges(camera, T_WC(), cylinder());
    const auto bend = [&](Eigen::Vector2d p) {
        if (!camera.has_distortion()) return p;
        return pixel_from_normalised(camera,
                                     {(p.x() - camera.cx) / camera.fx, (p.y() - camera.cy) / camera.fy});
    };
    const auto cut = [&](Eigen::Vector2d top, Eigen::Vector2d base, double moved) {
        const auto at = [&](double y) {
            return Eigen::Vector2d(top.x() + (y - top.y()) / (base.y() - top.y()) * (base.x() - top.x()), y);
        };
        const double first = std::max(top.y(), 0.0), last = std::min(base.y(), camera.height - 1.0);
        const Eigen::Vector2d offset(moved, 0.0);
        return std::array<Eigen::Vector2d, 2>{bend(at(first)) + offset, bend(at(last)) + offset};
    };
    Post result;
    if (!edges) return result;
    const auto left = cut(edges->left_top, edges->left_base, left_moved);
    const auto right = cut(edges->right_top, edges->right_base, right_moved);
    result.left_top = left[0], result.left_base = left[1];
    result.right_top = right[0], result.right_base = right[1];
    result.width_px = right[0].x() - left[0].x();
    result.distance_m = distance * 1.1;
    return result;
}

RoughOutline rough_outline_of(const DrawnPost& scene) {
    const Post corners = scene.found();
    RoughOutline outline{corners.left_top, corners.left_base, corners.right_top, corners.right_base};
    outline.first_row = static_cast<int>(corners.left_top.y()) + 2;
    outline.last_row = static_cast<int>(corners.left_base.y()) - 2;
    return outline;
}

PostColour colour_of(const DrawnPost& scene, YuyvView image) {
    PostColour colour;
    if (!PostColourEstimator().estimate(image, rough_outline_of(scene), {}, CameraResponse::linear, colour))
        ADD_FAILURE() << "no colour of its own";
    return colour;
}

DrawnPost small_scene() {
    DrawnPost scene;
    scene.camera.width = 160;
    scene.camera.height = 240;
    scene.camera.cx = 79.5;
    scene.camera.cy = 119.5;
    return scene;
}

}  // namespace goalmouth::test
