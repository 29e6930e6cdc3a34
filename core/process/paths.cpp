#include "core/process/paths.h"

#include "core/process/configuration.h"

#include <cstdlib>

namespace goalmouth {

std::filesystem::path program_folder() {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

std::filesystem::path config_folder() {
    if (const char* named = std::getenv("GOALMOUTH_CONFIG")) {
        if (std::filesystem::is_directory(named)) return named;
        throw ConfigurationError(std::string("$GOALMOUTH_CONFIG: ") + named + " is not a folder");
    }
    const auto bin = program_folder();
    const auto beside_build = (bin / ".." / ".." / "config").lexically_normal();
    const auto installed = (bin / ".." / "share" / "goalmouth" / "config").lexically_normal();
    for (const auto& place : {installed, beside_build}) {
        if (std::filesystem::is_directory(place / "modules")) return place;
    }
    throw ConfigurationError("no configuration folder: looked at $GOALMOUTH_CONFIG (not set), " +
                             installed.string() + " and " + beside_build.string());
}

}  // namespace goalmouth
