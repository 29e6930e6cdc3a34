#pragma once

#include <optional>
#include <variant>

#include <opencv2/core.hpp>

namespace goalmouth {

struct Click {
    cv::Point at;
};
struct Drag {
    cv::Point from, to;
};

/// Tells clicks from drags, by what the left button does over a window [px].
///
/// Qt's windows can be magnified, and a drag moves what is magnified then: the pointer stays on the same spot
/// of it while many movements are told. That is neither a click nor a drag of ours.
class ClickTracker {
  public:
    void press(cv::Point at) {
        pressed_ = at;
        moves_ = 0;
    }
    void move() { ++moves_; }
    std::variant<std::monostate, Click, Drag> release(cv::Point at) {
        if (!pressed_) return {};
        const cv::Point from = *pressed_;
        pressed_.reset();
        constexpr int shaky = 4;       // px
        constexpr int many_moves = 8;  // no click takes so many
        if (cv::norm(at - from) > shaky) return Drag{from, at};
        if (moves_ >= many_moves) return {};
        return Click{from};
    }

  private:
    std::optional<cv::Point> pressed_;
    int moves_ = 0;
};

}  // namespace goalmouth
