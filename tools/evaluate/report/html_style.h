#pragma once

namespace goalmouth {

/// The style sheet of every page, UTF-8.
const char* html_style();

}  // namespace goalmouth
