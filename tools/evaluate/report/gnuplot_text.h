#pragma once

#include <string>

namespace goalmouth {

/// `text` as gnuplot's string expression, in which nothing is special; lines stay lines.
std::string gnuplot_string(const std::string& text);

/// Valid UTF-8 with blanks for line ends and tabs.
std::string one_line(const std::string& text);

}  // namespace goalmouth
