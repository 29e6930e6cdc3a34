#include "core/simulation/truth.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

constexpr int samples_across = 7;
constexpr int samples_along = 48;

/// A tube that may hide a post from one place: all that does not depend on the ray is worked out once.
class Occluder {
  public:
    Occluder(const Cylinder& cylinder, const Eigen::Vector3d& eye)
        : axis_(cylinder.axis),
          from_base_(eye - cylinder.base),
          along_(from_base_.dot(axis_)),
          length_(cylinder.length) {
        const Eigen::Vector3d across = from_base_ - along_ * axis_;
        from_base_ = across;
        clearance_ = across.squaredNorm() - cylinder.radius * cylinder.radius;
    }

    /// Whether the ray eye + t·direction meets the side at 0 < t < limit.
    bool hides(const Eigen::Vector3d& direction, double limit) const {
        const double run = direction.dot(axis_);
        const double a = direction.squaredNorm() - run * run;
        const double b = direction.dot(from_base_);
        const double discriminant = b * b - a * clearance_;
        if (discriminant < 0.0 || a <= 0.0) return false;
        const double root = std::sqrt(discriminant);
        // Where the near side is beyond an end, the far one may not be: the ray enters through the end.
        for (const double t : {(-b - root) / a, (-b + root) / a}) {
            const double height = along_ + t * run;
            if (t > 0.0 && t < limit && height >= 0.0 && height <= length_) return true;
        }
        return false;
    }

  private:
    Eigen::Vector3d axis_;
    Eigen::Vector3d from_base_;  // eye from the axis, square to it
    double along_;               // m, eye along the axis from the base
    double length_;
    double clearance_;
};

/// What may hide a post from the camera.
struct Occluders {
    std::vector<Occluder> joined;  // end in a post: what is within the post does not count
    std::vector<Occluder> others;
    const Ball* ball = nullptr;

    /// Whether a point of the post, at the end of `ray` from the eye, is hidden.
    bool hide(const Eigen::Vector3d& eye, const Eigen::Vector3d& ray, double radius) const {
        const double post_side = 1.0 - 2.0 * radius / ray.norm();
        const auto any = [&](const std::vector<Occluder>& things, double limit) {
            return std::any_of(things.begin(), things.end(),
                               [&](const Occluder& o) { return o.hides(ray, limit); });
        };
        if (any(others, 1.0) || any(joined, post_side)) return true;
        if (ball == nullptr) return false;
        const auto t = hit(*ball, eye, ray);
        return t && *t < 1.0;
    }
};

Occluders occluders_of(const Scene& scene, const Eigen::Isometry3d& T_WC, const CylinderSilhouette& outline,
                       std::size_t id) {
    const Eigen::Vector3d eye = T_WC.translation();
    const Cylinder& post = scene.posts[id];
    // Only what reaches between the two tangent planes and is not all behind the post.
    const Eigen::Vector3d left = T_WC.linear() * outline.left_plane;
    const Eigen::Vector3d right = T_WC.linear() * outline.right_plane;
    const double farthest = std::max((post.base - eye).norm(), (post.top() - eye).norm()) + post.radius;
    const auto may_hide = [&](const Eigen::Vector3d& centre, double radius) {
        const Eigen::Vector3d to = centre - eye;
        return left.dot(to) > -radius && right.dot(to) > -radius && to.norm() - radius < farthest;
    };
    Occluders result;
    for (const Tube& tube : scene.tubes) {
        if (tube.post == static_cast<int>(id)) continue;
        const Cylinder& c = tube.cylinder;
        if (!may_hide(c.base + 0.5 * c.length * c.axis, std::hypot(0.5 * c.length, c.radius))) continue;
        const bool joined = tube.of == Tube::Of::goal && tube.post < 0;
        (joined ? result.joined : result.others).emplace_back(c, eye);
    }
    if (may_hide(scene.ball.centre, scene.ball.radius)) result.ball = &scene.ball;
    return result;
}

struct Shares {
    double inside = 0.0;
    double visible = 0.0;
};

/// Shares of the silhouette: sampled evenly across the angle between the tangent planes and along the axis.
Shares shares_of(const Scene& scene, const Intrinsics& camera, const Eigen::Isometry3d& T_WC,
                 const CylinderSilhouette& outline, std::size_t id) {
    const Eigen::Isometry3d T_CW = T_WC.inverse();
    const Eigen::Vector3d eye = T_WC.translation();
    const Cylinder& post = scene.posts[id];
    const Occluders occluders = occluders_of(scene, T_WC, outline, id);
    int inside = 0;
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
            const Eigen::Vector3d point_C = T_CW * point;
            const auto pixel = project(camera, point_C);
            if (!pixel || pixel->x() < -0.5 || pixel->y() < -0.5 || pixel->x() > camera.width - 0.5 ||
                pixel->y() > camera.height - 0.5 || folds_back(camera, point_C.head<2>() / point_C.z()))
                continue;
            ++inside;
            if (!occluders.hide(eye, point - eye, post.radius)) ++seen;
        }
    constexpr double all = samples_across * samples_along;
    return {inside / all, seen / all};
}

}  // namespace

std::vector<bool> hidden_points(const Scene& scene, const Eigen::Isometry3d& T_WC, std::size_t post,
                                std::span<const Eigen::Vector3d> points) {
    const auto outline = silhouette(scene.posts[post], T_WC);
    if (!outline) return std::vector<bool>(points.size(), true);
    const Occluders occluders = occluders_of(scene, T_WC, *outline, post);
    const Eigen::Vector3d eye = T_WC.translation();
    std::vector<bool> hidden;
    for (const Eigen::Vector3d& point : points)
        hidden.push_back(occluders.hide(eye, point - eye, scene.posts[post].radius));
    return hidden;
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
        if (!scene.stands(i)) continue;
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
        const Shares shares = shares_of(scene, camera, T_WC, *outline, i);
        post.inside = shares.inside;
        post.visible = shares.visible;
        result.push_back(post);
    }
    return result;
}

}  // namespace goalmouth
