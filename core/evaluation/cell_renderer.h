#pragma once

#include "core/evaluation/cell.h"
#include "core/evaluation/cell_view.h"
#include "core/evaluation/evaluation_scene.h"
#include "core/evaluation/post_sight.h"
#include "core/evaluation/reference_post.h"
#include "core/evaluation/visible_post.h"
#include "core/field/field.h"
#include "core/geometry/camera.h"
#include "core/geometry/camera_pose.h"
#include "core/imaging/yuyv.h"
#include "core/simulation/exposure.h"
#include "core/simulation/image_formation.h"
#include "core/simulation/renderer.h"
#include "core/simulation/truth.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// A scene as an evaluation knows it: a file of config/evaluation with the file of config/scenes it names.
struct EvaluationScene {
    std::string name;
    EvaluationSceneParameters parameters;
    ImageFormationParameters formation;
};

/// A true post of which some part is in the picture.
struct KnownPost {
    TruePost truth;
    ReferencePost outline;
};

/// A picture and what is known about it.
struct CellFrame {
    YuyvImage image;
    CellView view;
    std::vector<KnownPost> posts;
    std::optional<CameraPose> kinematics;  // what the robot would say of the camera
    std::optional<PostSight> sight;        // of the post in line, where it counts

    std::vector<ReferencePost> outlines() const;
};

/// The hall's light and the camera's exposure at the moment of a frame, over what the scene says of them.
struct FrameLight {
    Rgb factors{1.0F, 1.0F, 1.0F};  // of the hall's red, green and blue light, before noise and clipping
    double time = 0.0;              // s, when exposure and white balance are looked up
};

/// Draws the frames of the paper's experiment in one scene. Each is a function of (seed, scene, camera, cell,
/// index) alone, so that any of them can be drawn again. Not for more than one thread at a time.
class CellRenderer {
  public:
    /// `calibration`: the camera's, at the size of the pictures. Throws std::invalid_argument where the
    /// scene's parameters make no scene.
    CellRenderer(const EvaluationScene& scene, const Field& field, const Intrinsics& calibration,
                 std::uint64_t seed);

    /// cell 0 … cell_count − 1, index 0 … most_frames_per_cell − 1.
    CellFrame render(int cell, int index);
    /// The same view of the same hall in another light, without `sight`.
    CellFrame render_in(const FrameLight& light, int cell, int index);

    const Intrinsics& camera() const { return renderer_.camera(); }  // as it is, not as detectors are told

  private:
    Random random_for(const char* purpose, std::int64_t number) const;
    Scene draw_hall(const CellView& view, std::int64_t number) const;
    CellFrame draw(int cell, int index, const std::optional<FrameLight>& light);
    PostSight sight_in(const Shot& shot);  // of the post in line, in the renderer's hall

    EvaluationScene scene_;
    Field field_;
    std::uint64_t seed_;
    Renderer renderer_;
    Renderer clean_;  // of undisturbed frames
    Exposure exposure_;
};

}  // namespace goalmouth
