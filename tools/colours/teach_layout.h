#pragma once

#include "core/imaging/colour.h"

#include <array>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

namespace goalmouth {

class TeachEditor;

/// Where things stand in the window, in px of its canvas.
struct TeachLayout {
    cv::Rect header;
    cv::Rect picture;       // empty where it is not shown …
    cv::Rect segmentation;  // … and this likewise
    std::array<cv::Rect, colour_count> classes;
    cv::Rect tool_line, message_line;
    cv::Rect shown;  // the part of the picture in the panes, px of the picture

    /// The picture's pixel that is shown there, in either pane.
    std::optional<cv::Point> pixel_at(cv::Point canvas) const;
    std::optional<Colour> class_at(cv::Point canvas) const;
    /// Where a pixel's middle is drawn in a pane, which holds `shown`.
    cv::Point place_of(const cv::Rect& pane, cv::Point pixel) const;
};

TeachLayout layout_of(const TeachEditor& editor, cv::Size canvas);

/// A canvas on which pictures of that size stand side by side, and that fits the screen of a small laptop.
cv::Size first_canvas(cv::Size picture);

/// The least canvas whose lines can be read.
inline cv::Size least_canvas() {
    return {640, 240};
}

}  // namespace goalmouth
