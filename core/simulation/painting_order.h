#pragma once

#include "core/simulation/objects.h"

#include <memory>
#include <span>

namespace goalmouth {

/// Puts things into an order in which each can be painted over those before it: from far to near, and a thing
/// that can hide another after it. Two things are told apart by a plane between them, square to the shortest
/// way from one axis to the other: the one on the camera's side is in front. Where their axes meet
/// (a bar and its post), or a few hide each other in a circle, the distance alone decides.
void sort_for_painting(std::span<std::unique_ptr<SeenObject>> objects);

/// Which of two bodies may hide a part of the other; `unclear` where their axes meet.
enum class Hiding { none, by_first, by_second, unclear };
Hiding hiding(const SeenBody& first, const SeenBody& second);

}  // namespace goalmouth
