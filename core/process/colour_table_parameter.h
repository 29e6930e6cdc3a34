#pragma once

#include "core/imaging/colour_table.h"

#include <string>

namespace goalmouth {

/// The table a module's parameter `colours` names. Throws ConfigurationError, which begins with `module`,
/// where there is none.
ColourTable colour_table_parameter(const std::string& file, const std::string& module);

}  // namespace goalmouth
