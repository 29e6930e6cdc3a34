#pragma once

#include "core/colour_teaching/colour_mark.h"
#include "tools/colours/learning_pictures.h"
#include "tools/colours/marks_file.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace goalmouth {

/// Pictures, and marks in them.
struct MarkedPictures {
    std::vector<NamedPicture> pictures;
    std::vector<ColourMark> marks;  // ColourMark::picture counts in `pictures`
};

/// Adds the marks read from `file`, and those of the pictures they name that are not there yet. `size`: of
/// raw pictures. Throws ConfigurationError with file and line where a picture cannot be read or a mark does
/// not fit it.
void add_marks(MarkedPictures& to, const std::vector<MarkLine>& lines, const std::filesystem::path& file,
               std::optional<ImageSize> size);

/// Back to lines of a file.
std::vector<MarkLine> lines_of(const std::vector<ColourMark>& marks,
                               const std::vector<NamedPicture>& pictures);

}  // namespace goalmouth
