#pragma once

#include "core/simulation/room.h"
#include "core/simulation/scene.h"

namespace goalmouth {

/// Each draws from a generator of its own, seeded by SceneParameters::clutter_seed, so that more of one thing
/// leaves the others where they are.

/// Coloured rectangles on the walls: posters, cupboards, table tops.
void add_posters(Scene& scene, const Room& room, const SceneParameters& parameters);

/// People between carpet and walls.
void add_spectators(Scene& scene, const SceneParameters& parameters);

/// Things in a colour near the goals', beyond the carpet: in turn a pole, a banner on a wall, a person's
/// shirt.
void add_distractors(Scene& scene, const Room& room, const SceneParameters& parameters, const Rgb& goals);

}  // namespace goalmouth
