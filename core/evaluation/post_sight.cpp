#include "core/evaluation/post_sight.h"

#include "core/geometry/cylinder.h"
#include "core/simulation/truth.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace goalmouth {
namespace {

/// RGB → (Y, Cb − 128, Cr − 128), BT.601 full range.
Eigen::Matrix3d from_rgb() {
    Eigen::Matrix3d m;
    m << 0.299, 0.587, 0.114, -0.168736, -0.331264, 0.5, 0.5, -0.418688, -0.081312;
    return m;
}

Eigen::Vector3d colour_at(YuyvView image, int x, int y) {
    const Ycbcr c = image.at(x, y);
    return {static_cast<double>(c.y), c.cb - 128.0, c.cr - 128.0};
}

/// The pixel a place lies in.
std::optional<Eigen::Vector2i> pixel_of(YuyvView image, const Eigen::Vector2d& place) {
    const int x = static_cast<int>(std::lround(place.x()));
    const int y = static_cast<int>(std::lround(place.y()));
    if (x < 0 || y < 0 || x >= image.width || y >= image.height) return std::nullopt;
    return Eigen::Vector2i(x, y);
}

/// What the levels of a place get as noise, for one pixel.
Eigen::Matrix3d noise_at(const Eigen::Vector3d& colour, const SensorParameters& sensor) {
    static const Eigen::Matrix3d to_rgb = from_rgb().inverse();
    const Eigen::Vector3d light = (to_rgb * colour).cwiseMax(0.0);
    return ycbcr_noise((sensor.photon_noise * light).array() + sensor.read_noise * sensor.read_noise);
}

/// A place on a line of the post as the camera sees it when the row it lies in is read.
class MovingView {
  public:
    MovingView(const Intrinsics& camera, const CameraMotion& motion, const ShutterParameters& shutter)
        : camera_(camera), motion_(motion), shutter_(shutter) {}

    std::optional<Eigen::Vector2d> pixel(const Eigen::Vector3d& point, double later = 0.0) const {
        constexpr int settled = 4;  // a frame's rows move by far less than the frame
        auto place = project_at(point, later);
        const bool rolls = !motion_.still() && shutter_.readout > 0.0;
        for (int i = 0; rolls && place && i < settled; ++i)
            place = project_at(point, row_time(shutter_, place->y(), camera_.height) + later);
        return place;
    }
    /// How far it moves while its row gathers light [px].
    Eigen::Vector2d smear(const Eigen::Vector3d& point) const {
        if (motion_.still() || shutter_.exposure == 0.0) return Eigen::Vector2d::Zero();
        const auto first = pixel(point, -0.5 * shutter_.exposure);
        const auto last = pixel(point, 0.5 * shutter_.exposure);
        return first && last ? Eigen::Vector2d(*last - *first) : Eigen::Vector2d(Eigen::Vector2d::Zero());
    }

  private:
    std::optional<Eigen::Vector2d> project_at(const Eigen::Vector3d& point, double seconds) const {
        const Eigen::Vector3d in_camera = motion_.at(seconds).inverse() * point;
        if (in_camera.z() <= 0.01 || folds_back(camera_, in_camera.head<2>() / in_camera.z()))
            return std::nullopt;
        return project(camera_, in_camera);
    }

    const Intrinsics& camera_;
    const CameraMotion& motion_;
    const ShutterParameters& shutter_;
};

Rgb post_colour(const Scene& scene, std::size_t post) {
    for (const Tube& tube : scene.tubes)
        if (tube.post == static_cast<int>(post)) return tube.colour;
    return {};
}

}  // namespace

ImageFormationParameters undisturbed(ImageFormationParameters formation) {
    formation.shutter.exposure = 0.0;
    formation.sensor.blur = 0.0;
    formation.sensor.read_noise = 0.0;
    formation.sensor.photon_noise = 0.0;
    formation.processing = {};
    return formation;
}

PostSight sight_of(const Scene& scene, std::size_t post, const Intrinsics& camera, const CameraMotion& motion,
                   const ImageFormationParameters& formation, const Rgb& gains, YuyvView clean) {
    PostSight sight;
    const Cylinder& cylinder = scene.posts[post];
    const auto outline = silhouette(cylinder, motion.T_WC);
    if (!outline) return sight;
    const Rgb paint = post_colour(scene, post);
    const Eigen::Vector3d own =
        from_rgb() * Eigen::Vector3d(paint.r * gains.r, paint.g * gains.g, paint.b * gains.b);
    const MovingView view(camera, motion, formation.shutter);

    for (std::size_t side = 0; side < 2; ++side) {
        const Eigen::Vector3d contact =
            cylinder.radius * (side == 0 ? outline->left_contact : outline->right_contact);
        // Even steps up the post, finer than rows wherever it is in the picture.
        const int steps = 2 * camera.height;
        std::vector<Eigen::Vector3d> points;
        for (int i = 0; i < steps; ++i)
            points.push_back(cylinder.base + contact + (i + 0.5) / steps * cylinder.length * cylinder.axis);
        const std::vector<bool> hidden = hidden_points(scene, motion.T_WC, post, points);
        const Eigen::Vector3d half_step = 0.5 / steps * cylinder.length * cylinder.axis;
        double whole = 0.0;
        double seen = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto place = view.pixel(points[i]);
            const auto above = view.pixel(points[i] + half_step);
            const auto below = view.pixel(points[i] - half_step);
            if (!place || !above || !below) continue;
            if (place->y() < -0.5 || place->y() > camera.height - 0.5) continue;
            EdgePiece piece;
            piece.pixel = *place;
            piece.length = (*above - *below).norm();
            whole += piece.length;
            if (hidden[i] || !(piece.length > 0.0)) continue;
            const Eigen::Vector2d along = (*above - *below) / piece.length;  // up the post
            const Eigen::Vector2d outwards =
                (side == 0 ? 1.0 : -1.0) * Eigen::Vector2d(along.y(), -along.x());
            const auto near = pixel_of(clean, *place + 2.0 * outwards);
            const auto far = pixel_of(clean, *place + 3.0 * outwards);
            const auto inside = pixel_of(clean, *place - outwards);
            if (!near || !far || !inside) continue;
            EdgeLook& look = piece.look;
            look.background =
                0.5 * (colour_at(clean, near->x(), near->y()) + colour_at(clean, far->x(), far->y()));
            const double brightness =
                own.x() > 0.0 ? std::max(colour_at(clean, inside->x(), inside->y()).x(), 1.0) / own.x() : 1.0;
            look.post = brightness * own;
            look.post_noise = noise_at(look.post, formation.sensor);
            look.background_noise = noise_at(look.background, formation.sensor);
            const double moved = view.smear(points[i]).dot(outwards);
            look.blur = std::sqrt(formation.sensor.blur * formation.sensor.blur + moved * moved / 12.0);
            if (contrast_to_noise(look) >= least_contrast_to_noise) seen += piece.length;
            sight.edges[side].push_back(piece);
        }
        sight.seen[side] = whole > 0.0 ? seen / whole : 0.0;
    }
    sight.bound = post_bound(camera, *outline, sight.edges[0], sight.edges[1]);
    return sight;
}

}  // namespace goalmouth
