#include "core/simulation/renderer.h"

#include "core/simulation/image_motion.h"
#include "core/simulation/vectorised.h"

#include <algorithm>
#include <utility>

namespace goalmouth {
namespace {

GOALMOUTH_VECTORISED void add(const LightRow& from, const LightRow& to) {
    for (int u = 0; u < to.width; ++u) to.r[u] += from.r[u];
    for (int u = 0; u < to.width; ++u) to.g[u] += from.g[u];
    for (int u = 0; u < to.width; ++u) to.b[u] += from.b[u];
}

void scale(const LightRow& row, float factor) {
    for (int u = 0; u < row.width; ++u) row.r[u] *= factor;
    for (int u = 0; u < row.width; ++u) row.g[u] *= factor;
    for (int u = 0; u < row.width; ++u) row.b[u] *= factor;
}

}  // namespace

Renderer::Renderer(Scene scene, const Intrinsics& camera, const ImageFormationParameters& formation)
    : scene_(std::move(scene)),
      light_(formation.light),
      shutter_(formation.shutter),
      blur_(formation.sensor.blur),
      rays_(camera),
      limits_(rays_),
      ground_(scene_, light_, camera),
      sensor_(formation.sensor, rays_),
      processing_(formation.processing, camera.width, camera.height) {}

void Renderer::change_scene(Scene scene) {
    scene_ = std::move(scene);
    ground_.change_scene(scene_, light_);
}

void Renderer::render(const Shot& shot, Random& random, std::uint8_t* out, std::ptrdiff_t stride) {
    sensor_.begin(out, stride, shot.gains, random);
    if (shot.camera.still() || (shutter_.exposure == 0.0 && shutter_.readout == 0.0))
        paint_still(shot.camera.T_WC);
    else
        paint_moving(shot.camera);
    processing_.run(out, stride);
}

void Renderer::paint_still(const Eigen::Isometry3d& T_WC) {
    views_.resize(1);
    views_[0].look(all_things(scene_), light_, rays_, T_WC);
    for (int row = 0; row < camera().height; ++row) {
        const RowRays rays = rays_.row(row);
        views_[0].begin_row(row, rays, nullptr);
        paint_row(views_[0], rays, T_WC, sensor_.next_row());
        sensor_.finish_row();
    }
    views_.clear();
}

void Renderer::paint_row(View& view, const RowRays& rays, const Eigen::Isometry3d& T_WC,
                         const LightRow& light) {
    ground_.look(T_WC);
    for (const SeenObject::Columns& open : view.uncovered())
        ground_.paint(
            {rays.x + open.first, rays.y + open.first, rays.straight},
            {light.r + open.first, light.g + open.first, light.b + open.first, open.last - open.first + 1});
    view.paint(light);
}

void Renderer::paint_moving(const CameraMotion& motion) {
    const int height = camera().height;
    const Things things =
        things_in_view(all_things(scene_), limits_, motion, 0.5 * (shutter_.readout + shutter_.exposure));
    const ShutterSampling sampling = shutter_sampling(
        shutter_, height,
        image_speed(camera(), motion, distance_to_nearest(things, motion.T_WC.translation())), blur_);
    const int samples = sampling.samples;
    const auto instant = [&](double row, int sample) {
        return row_time(shutter_, row, height) + ((sample + 0.5) / samples - 0.5) * shutter_.exposure;
    };
    views_.resize(static_cast<std::size_t>(samples));
    for (int first = 0; first < height; first += sampling.band_rows) {
        const int last = std::min(first + sampling.band_rows, height) - 1;
        const double middle = 0.5 * (first + last);
        const double centre = row_time(shutter_, middle, height);
        const Things in_band = things_in_view(
            things, ViewLimits(rays_, first, last), {motion.at(centre), motion.velocity, motion.turn_rate},
            row_time(shutter_, last, height) - centre + 0.5 * shutter_.exposure);
        for (int k = 0; k < samples; ++k)
            views_[static_cast<std::size_t>(k)].look(in_band, light_, rays_, motion.at(instant(middle, k)));
        const bool as_set_up = first == last || shutter_.readout == 0.0;
        for (int row = first; row <= last; ++row) {
            const LightRow sum = sensor_.next_row();
            const RowRays rays = rays_.row(row);
            for (int k = 0; k < samples; ++k) {
                View& view = views_[static_cast<std::size_t>(k)];
                const LightRow light = k == 0 ? sum : sample_row();
                const Eigen::Isometry3d T_WC = as_set_up ? view.T_WC() : motion.at(instant(row, k));
                view.begin_row(row, rays, as_set_up ? nullptr : &T_WC);
                paint_row(view, rays, T_WC, light);
                if (k > 0) add(light, sum);
            }
            if (samples > 1) scale(sum, 1.0F / static_cast<float>(samples));
            sensor_.finish_row();
        }
    }
    views_.clear();
}

LightRow Renderer::sample_row() {
    const auto width = static_cast<std::size_t>(camera().width);
    sample_.resize(3 * width);
    return {sample_.data(), sample_.data() + width, sample_.data() + 2 * width, camera().width};
}

YuyvImage Renderer::render(const Shot& shot, Random& random) {
    YuyvImage image(camera().width, camera().height);
    render(shot, random, image.data.data(), image.stride());
    return image;
}

}  // namespace goalmouth
