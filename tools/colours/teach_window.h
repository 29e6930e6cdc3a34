#pragma once

#include <functional>

namespace goalmouth {

class TeachEditor;

/// Shows the editor until it is done or `interrupted` says so, and hands it keys and mouse. Throws
/// cv::Exception where the window cannot be opened; without a display (display_check.h) some libraries end
/// the process.
void run_teach_window(TeachEditor& editor, const std::function<bool()>& interrupted);

}  // namespace goalmouth
