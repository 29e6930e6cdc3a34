#pragma once

#include "core/colour_teaching/colour_mark.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// A picture as marks name it.
struct MarkedPicture {
    std::filesystem::path file;        // a picture, or a log …
    std::optional<std::size_t> place;  // … and the picture's number there, from 0
    bool operator==(const MarkedPicture&) const = default;
};

/// A line of a file of marks.
struct MarkLine {
    MarkedPicture picture;
    Colour colour = Colour::unclassified;
    MarkShape shape;
    int line = 0;  // its number in the file it was read from
};

/// A text file with a mark a line, "#" beginning a remark:
///
///     PICTURE CLASS X0 Y0 X1 Y1            a box by two corners, inclusive
///     PICTURE CLASS polygon X Y X Y X Y …
///     PICTURE CLASS fill X Y TOLERANCE
///
/// Pictures lie relative to the file; PICTURE is LOG@N for a log's picture number N, from 0, and stands
/// between quotation marks where it holds a blank or "#" (\" and \\ for those themselves). Throws
/// ConfigurationError with file and line, also where there is no mark at all.
std::vector<MarkLine> read_marks(const std::filesystem::path& file);

/// The text that read_marks() takes for these, standing in a file of that folder. Throws ConfigurationError
/// for a picture whose name has a line's end in it.
std::string marks_text(const std::vector<MarkLine>& marks, const std::filesystem::path& folder);

}  // namespace goalmouth
