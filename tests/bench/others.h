#pragma once

#include "core/imaging/colour_table.h"
#include "tests/bench/contender.h"
#include "tests/bench/frames.h"

#include <vector>

namespace goalmouth::bench {

// What people would use in place of our stages, as OpenCV's users write it: pictures between two calls are
// kept from frame to frame. OpenCV's threads are the caller's business. All refer to the frames they are
// given.

Contender hsv_contours(const FrameSet& frames);
/// Goals, field and lines, each cleaned by an opening.
Contender hsv_contours_of_three(const FrameSet& frames);
Contender canny_hough(const FrameSet& frames);
/// With lower thresholds, which find more of the posts, and more of everything.
Contender sensitive_canny_hough(const FrameSet& frames);
Contender line_segment_detector(const FrameSet& frames);
/// Not where OpenCV has no contrib modules.
std::vector<Contender> fast_line_detector(const FrameSet& frames);

/// The table asked for every pixel of the frame, the classes kept as a picture.
Contender full_lookup(const FrameSet& frames, const ColourTable& table);
/// The floor: every byte of the frame read once.
Contender frame_read(const FrameSet& frames);

}  // namespace goalmouth::bench
