#pragma once

#include "core/colour_teaching/teaching_session.h"

#include <cstddef>

#include <opencv2/core.hpp>

namespace goalmouth {

class TeachEditor;

/// What the window shows: the picture with its marks, its segmentation by the table they make, classes, tool
/// and message. Keeps what the next look may need again.
class TeachView {
  public:
    /// CV_8UC3, BGR, of that size.
    cv::Mat draw(const TeachEditor& editor, cv::Size canvas);

  private:
    void look_at(const TeachEditor& editor);

    std::size_t number_ = 0;  // of the picture
    cv::Mat picture_;         // empty before the first look
    TeachingSession::Marks marks_;
    cv::Mat segmentation_;  // by the table of those; empty where there is none
};

}  // namespace goalmouth
