#include "tools/colours/teach_layout.h"

#include "tools/colours/teach_editor.h"

#include <algorithm>

namespace goalmouth {

namespace {

constexpr int line_height = 24;  // px
constexpr int gap = 6;           // px, between and around panes
constexpr int lines = 4;         // header, classes, tool, message

/// The largest of `shape`'s proportions in the middle of `room`.
cv::Rect fitted(cv::Size shape, const cv::Rect& room) {
    const double scale = std::min(static_cast<double>(room.width) / shape.width,
                                  static_cast<double>(room.height) / shape.height);
    const cv::Size size(std::max(1, cvFloor(scale * shape.width)),
                        std::max(1, cvFloor(scale * shape.height)));
    return {room.x + (room.width - size.width) / 2, room.y + (room.height - size.height) / 2, size.width,
            size.height};
}

}  // namespace

std::optional<cv::Point> TeachLayout::pixel_at(cv::Point canvas) const {
    for (const cv::Rect& pane : {picture, segmentation}) {
        if (!pane.contains(canvas)) continue;
        return cv::Point(shown.x + (canvas.x - pane.x) * shown.width / pane.width,
                         shown.y + (canvas.y - pane.y) * shown.height / pane.height);
    }
    return std::nullopt;
}

std::optional<Colour> TeachLayout::class_at(cv::Point canvas) const {
    for (std::size_t c = 0; c < classes.size(); ++c)
        if (classes[c].contains(canvas)) return static_cast<Colour>(c);
    return std::nullopt;
}

cv::Point TeachLayout::place_of(const cv::Rect& pane, cv::Point pixel) const {
    return {pane.x + cvFloor((pixel.x - shown.x + 0.5) * pane.width / shown.width),
            pane.y + cvFloor((pixel.y - shown.y + 0.5) * pane.height / shown.height)};
}

TeachLayout layout_of(const TeachEditor& editor, cv::Size canvas) {
    TeachLayout layout;
    layout.shown = editor.shown();
    layout.header = {0, 0, canvas.width, line_height};
    const int panes_end = canvas.height - (lines - 1) * line_height;
    const cv::Rect room(gap, line_height, canvas.width - 2 * gap, panes_end - line_height - gap);
    if (editor.panes() == ShownPanes::both) {
        const int half = (room.width - gap) / 2;
        layout.picture = fitted(layout.shown.size(), {room.x, room.y, half, room.height});
        layout.segmentation = fitted(layout.shown.size(), {room.br().x - half, room.y, half, room.height});
    } else {
        (editor.panes() == ShownPanes::picture ? layout.picture : layout.segmentation) =
            fitted(layout.shown.size(), room);
    }
    const int width = canvas.width / colour_count;
    for (int c = 0; c < colour_count; ++c)
        layout.classes[static_cast<std::size_t>(c)] = {c * width, panes_end, width, line_height};
    layout.tool_line = {0, panes_end + line_height, canvas.width, line_height};
    layout.message_line = {0, panes_end + 2 * line_height, canvas.width, line_height};
    return layout;
}

cv::Size first_canvas(cv::Size picture) {
    constexpr int pane_width = 620, tallest = 520;  // px
    const int height = std::clamp(pane_width * picture.height / picture.width, 200, tallest);
    return {2 * pane_width + 3 * gap, height + lines * line_height + gap};
}

}  // namespace goalmouth
