#pragma once

#include <functional>
#include <string>

namespace goalmouth {

class TeachEditor;

/// Why no window can be opened here, to stand in a sentence; "" where one can. Must be asked while the
/// process has one thread: GUI libraries end the process where there is no display, so a child tries.
std::string window_problem();

/// Shows the editor until it is done or `interrupted` says so, and hands it keys and mouse. Throws
/// std::runtime_error where the window cannot be opened.
void run_teach_window(TeachEditor& editor, const std::function<bool()>& interrupted);

}  // namespace goalmouth
