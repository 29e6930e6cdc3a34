#pragma once

#include "core/localisation/frame_aligner.h"

#include <goalmouth/posts_t.hpp>

namespace goalmouth {

/// A posts message as localisation takes it.
PostsFrame posts_frame(const posts_t& message);

}  // namespace goalmouth
