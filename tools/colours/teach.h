#pragma once

#include "core/imaging/image_file.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

struct TeachColoursOptions {
    std::vector<std::string> inputs;  // a file of marks; or pictures, folders of them, LCM logs
    std::filesystem::path
        marks;  // of the window: read where it is there, and saved; "": the output's, .marks
    std::optional<ImageSize> size;  // of raw pictures
    std::filesystem::path output;
    std::string name;  // "": the output's
    int bits = 6;
    std::size_t most = 40;  // of more pictures, so many evenly spread
};

/// Makes a table from marked pictures: those of a file of marks (marks_file.h), or those that a person marks
/// in a window. Says how much of each class the table gets back. Returns the exit code. Throws
/// ConfigurationError; the table that was there is left then.
int teach_colours(const TeachColoursOptions& options);

}  // namespace goalmouth
