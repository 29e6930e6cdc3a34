#include "core/simulation/truth.h"

#include <cmath>

namespace goalmouth {
namespace {

constexpr int samples_across = 7;
constexpr int samples_along = 48;

/// The silhouette's share that a camera sees: sampled evenly across the angle between the tangent planes and
/// along the axis.
double visible_share(const Scene& scene, const Intrinsics& camera, const Eigen::Isometry3d& T_WC,
                     const CylinderSilhouette& outline, std::size_t id) {
    const Eigen::Isometry3d T_CW = T_WC.inverse();
    const Eigen::Vector3d eye = T_WC.translation();
    const Cylinder& post = scene.posts[id];
    const auto bars = crossbars(scene.field);
    int seen = 0;
    for (int i = 0; i < samples_across; ++i)
        for (int k = 0; k < samples_along; ++k) {
            const double across = (i + 0.5) / samples_across;
            const double along = (k + 0.5) / samples_along;
            // On the chord between the two lines where the tangent planes touch: even steps there are even
            // steps in the image.
            const Eigen::Vector3d point =
                post.base + along * post.length * post.axis +
                post.radius * ((1.0 - across) * outline.left_contact + across * outline.right_contact);
            const auto pixel = project(camera, T_CW * point);
            if (!pixel || pixel->x() < -0.5 || pixel->y() < -0.5 || pixel->x() > camera.width - 0.5 ||
                pixel->y() > camera.height - 0.5)
                continue;
            const Eigen::Vector3d ray = point - eye;
            const double reach = 1.0 - 2.0 * post.radius / ray.norm();  // the post's own bar ends in it
            const auto hides = [&](const auto& thing) {
                const auto t = hit(thing, eye, ray);
                return t && *t < reach;
            };
            bool hidden = hides(scene.ball);
            for (std::size_t other = 0; other < scene.posts.size() && !hidden; ++other)
                hidden = other != id && hides(scene.posts[other]);
            for (const Cylinder& bar : bars) hidden = hidden || hides(bar);
            if (!hidden) ++seen;
        }
    return static_cast<double>(seen) / (samples_across * samples_along);
}

}  // namespace

std::optional<double> hit(const Cylinder& cylinder, const Eigen::Vector3d& from,
                          const Eigen::Vector3d& direction) {
    const Eigen::Vector3d to_base = from - cylinder.base;
    const Eigen::Vector3d d = direction - direction.dot(cylinder.axis) * cylinder.axis;
    const Eigen::Vector3d p = to_base - to_base.dot(cylinder.axis) * cylinder.axis;
    const double a = d.squaredNorm();
    const double b = d.dot(p);
    const double discriminant = b * b - a * (p.squaredNorm() - cylinder.radius * cylinder.radius);
    if (a <= 0.0 || discriminant < 0.0) return std::nullopt;
    const double t = (-b - std::sqrt(discriminant)) / a;
    const double height = (to_base + t * direction).dot(cylinder.axis);
    if (t <= 0.0 || height < 0.0 || height > cylinder.length) return std::nullopt;
    return t;
}

std::optional<double> hit(const Ball& ball, const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
    const Eigen::Vector3d p = from - ball.centre;
    const double a = direction.squaredNorm();
    const double b = direction.dot(p);
    const double discriminant = b * b - a * (p.squaredNorm() - ball.radius * ball.radius);
    if (discriminant < 0.0) return std::nullopt;
    const double t = (-b - std::sqrt(discriminant)) / a;
    if (t <= 0.0) return std::nullopt;
    return t;
}

std::vector<TruePost> true_posts(const Scene& scene, const Intrinsics& camera,
                                 const Eigen::Isometry3d& T_WC) {
    std::vector<TruePost> result;
    for (std::size_t i = 0; i < scene.posts.size(); ++i) {
        const auto outline = silhouette(scene.posts[i], T_WC);
        const auto edges = project_edges(camera, T_WC, scene.posts[i]);
        if (!outline || !edges) continue;
        TruePost post;
        post.id = static_cast<int>(i);
        post.position = scene.posts[i].base.head<2>();
        post.distance_m = (post.position - T_WC.translation().head<2>()).norm();
        post.edges = *edges;
        const double middle =
            0.25 * (edges->left_base + edges->left_top + edges->right_base + edges->right_top).x();
        post.bearing_rad = -std::atan((middle - camera.cx) / camera.fx);
        post.visible = visible_share(scene, camera, T_WC, *outline, i);
        result.push_back(post);
    }
    return result;
}

}  // namespace goalmouth
