#include "core/evaluation/cell_renderer.h"

#include "core/evaluation/edge_path.h"
#include "core/evaluation/measured_pose.h"
#include "core/geometry/segment.h"
#include "core/simulation/robot.h"

#include <algorithm>
#include <utility>

namespace goalmouth {
namespace {

constexpr double robot_width = 0.25;  // m, shoulder to shoulder of a DARwIn-OP with its arms

/// Halls place their robots anywhere; not where the camera's own robot stands.
bool leaves_room(const Scene& scene, const Eigen::Vector3d& eye) {
    constexpr double clear = 0.3;  // m
    for (const Tube& tube : scene.tubes) {
        if (tube.of != Tube::Of::robot) continue;
        const Cylinder& c = tube.cylinder;
        if (distance_to_segment<2>(c.base.head<2>(), c.top().head<2>(), eye.head<2>()) < clear) return false;
    }
    return true;
}

void add_occluder(Scene& scene, const Occluder& occluder, const Eigen::Vector3d& eye) {
    const Rgb cyan{40, 170, 200};
    const Rgb magenta{200, 50, 150};
    const Eigen::Vector2d post = scene.posts[post_in_line].base.head<2>();
    const Eigen::Vector2d way = post - eye.head<2>();
    const Eigen::Vector2d left = Eigen::Vector2d(-way.y(), way.x()).normalized();
    const double reach = scene.field.post_diameter + robot_width;
    const Eigen::Vector2d place = eye.head<2>() + occluder.way * way + occluder.sideways * reach * left;
    RobotPlace robot;
    robot.pose = {place.x(), place.y(), occluder.heading};
    robot.fallen = occluder.fallen;
    robot.jersey = occluder.magenta ? magenta : cyan;
    add_robot(scene, robot);
}

}  // namespace

std::vector<ReferencePost> CellFrame::outlines() const {
    std::vector<ReferencePost> result;
    for (const KnownPost& post : posts) result.push_back(post.outline);
    return result;
}

CellRenderer::CellRenderer(const EvaluationScene& scene, const Field& field, const Intrinsics& calibration,
                           std::uint64_t seed)
    : scene_(scene),
      field_(field),
      seed_(seed),
      renderer_(make_scene(field, scene.formation.hall), true_camera(calibration, scene.parameters.lens),
                scene.formation),
      clean_(renderer_.scene(), renderer_.camera(), undisturbed(scene.formation)),
      exposure_(scene.formation.exposure, scene.formation.light.temperature, random_for("exposure", 0)) {}

Random CellRenderer::random_for(const char* purpose, std::int64_t number) const {
    return random_for_frame(seed_, "evaluation/" + scene_.name + "/" + purpose, number);
}

Scene CellRenderer::draw_hall(const CellView& view, std::int64_t number) const {
    constexpr std::uint32_t seeds = 1'000'000'000;
    constexpr int most_tries = 100;
    const Eigen::Vector3d eye = view.camera.T_WC.translation();
    Random random = random_for("hall", number);
    SceneParameters hall = scene_.formation.hall;
    Scene scene;
    for (int i = 0; i < most_tries; ++i) {
        hall.clutter_seed = static_cast<int>(random.index(seeds));
        scene = make_scene(field_, hall);
        if (leaves_room(scene, eye)) break;
    }
    if (view.occluder) add_occluder(scene, *view.occluder, eye);
    return scene;
}

PostSight CellRenderer::sight_in(const Shot& shot) {
    clean_.change_scene(renderer_.scene());
    Random none(0);
    const YuyvImage clean = clean_.render(shot, none);
    return sight_of(clean_.scene(), post_in_line, camera(), shot.camera, scene_.formation, shot.gains,
                    clean.view());
}

CellFrame CellRenderer::render(int cell, int index) {
    return draw(cell, index, std::nullopt);
}

CellFrame CellRenderer::render_in(const FrameLight& light, int cell, int index) {
    return draw(cell, index, light);
}

CellFrame CellRenderer::draw(int cell, int index, const std::optional<FrameLight>& light) {
    const std::int64_t number = frame_number(cell, index);
    CellFrame frame;
    frame.view =
        draw_view(random_for("view", number), scene_.parameters, field_, evaluation_cell(cell), camera());
    renderer_.change_scene(draw_hall(frame.view, number));
    Random noise = random_for("noise", number);
    if (light) frame.view.time = light->time;
    Shot shot{frame.view.camera, exposure_.gains(frame.view.time)};
    if (light) {
        shot.gains.r *= light->factors.r;
        shot.gains.g *= light->factors.g;
        shot.gains.b *= light->factors.b;
    }
    frame.image = renderer_.render(shot, noise);
    frame.kinematics =
        measured_pose(frame.view.camera.T_WC, scene_.parameters.kinematics, random_for("kinematics", number));

    const CountingRule rule{scene_.parameters.least_inside, scene_.parameters.occluders.largest_hidden};
    const Scene& scene = renderer_.scene();
    for (const TruePost& truth : true_posts(scene, camera(), frame.view.camera.T_WC)) {
        const Cylinder& post = scene.posts[static_cast<std::size_t>(truth.id)];
        const auto edges = edges_in_picture(camera(), frame.view.camera, scene_.formation.shutter, post);
        const auto outline = visible_outline(truth, edges, camera(), rule);
        if (!outline) continue;
        frame.posts.push_back({truth, *outline});
        if (truth.id == post_in_line && outline->counts && !light) frame.sight = sight_in(shot);
    }
    return frame;
}

}  // namespace goalmouth
