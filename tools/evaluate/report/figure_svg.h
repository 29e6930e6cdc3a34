#pragma once

#include <string>

namespace goalmouth {

/// What gnuplot wrote, for a file: on white, with the figure's own title and fonts that every system has.
std::string standalone_svg(const std::string& drawn, const std::string& title);

/// The same as an element of an HTML page: no prolog and no page of its own, ids that begin with `stem`, text
/// and axes in the colour of the text around it.
std::string inline_svg(const std::string& drawn, const std::string& title, const std::string& stem);

}  // namespace goalmouth
