#pragma once

#include "core/field/field.h"
#include "core/geometry/camera.h"
#include "core/refinement/distance_cues.h"
#include "core/refinement/post_extent.h"
#include "core/refinement/post_silhouette.h"

#include <optional>

namespace goalmouth {

/// What a post of a silhouette's width would have to do with the ground.
struct PostStand {
    /// From this row down a post shows its own edges: the underside of its crossbar, where a silhouette so
    /// many times as wide is right. Nothing where nothing tells how far the camera is above its foot.
    std::optional<double> crossbar_row(double wider) const;
    /// Whether its colour ends at the top where a silhouette so many times as wide would.
    bool reaches(double wider) const;

    /// Its colour goes on farther up than a post so far away can, whatever the camera's pose is: above that
    /// stands something else of its colour, or it is nearer, and wider.
    bool overtops = false;
    /// Its colour goes on farther down than a post so far away can, whatever the camera's pose is within its
    /// errors: it is nearer, and wider, than that.
    bool sinks = false;

    Intrinsics camera;
    PostSilhouette post;
    double distance = 0.0, radius = 0.0, goal_height = 0.0;  // m
    std::optional<double> top;                               // slope along the axis, where it ends at the top
    std::optional<double> height;                            // m, of the camera; from its pose
    std::optional<double> foot;                              // slope, where it ends at the foot
    double sigma = 0.0;                                      // of slopes
};

/// `stance`: where the camera's pose is known; `lean_sigma` [rad]: of the vertical along the line of sight.
PostStand post_stand(const PostSilhouette& post, const PostExtent& extent,
                     const std::optional<CameraStance>& stance, double lean_sigma, const Intrinsics& camera,
                     const Field& field);

}  // namespace goalmouth
