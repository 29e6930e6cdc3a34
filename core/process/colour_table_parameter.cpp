#include "core/process/colour_table_parameter.h"

#include "core/imaging/colour_table_file.h"
#include "core/imaging/file_error.h"
#include "core/process/configuration.h"

namespace goalmouth {

ColourTable colour_table_parameter(const std::string& file, const std::string& module) {
    if (file.empty()) {
        throw ConfigurationError(module +
                                 ": no colour table: set `colours` to a .gmct file, such as "
                                 "config/colours/simulator.gmct");
    }
    try {
        return load_colour_table(file);
    } catch (const FileError& error) {
        throw ConfigurationError(module + ": " + error.what());
    }
}

}  // namespace goalmouth
