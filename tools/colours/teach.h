#pragma once

#include "core/imaging/colour.h"
#include "core/imaging/image_file.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace goalmouth {

/// A part of a picture that shows one class.
struct ColourBox {
    std::filesystem::path picture;
    Colour colour = Colour::unclassified;
    cv::Rect box;  // px
    int line = 0;  // of the file it was read from
};

/// A text file with a box a line: PICTURE CLASS X0 Y0 X1 Y1, corners inclusive, the picture relative to the
/// file;
/// "#" begins a remark. Throws ConfigurationError with file and line.
std::vector<ColourBox> read_colour_boxes(const std::filesystem::path& file);

struct TeachColoursOptions {
    std::filesystem::path boxes;
    std::optional<ImageSize> size;  // of raw pictures
    std::filesystem::path output;
    std::string name;  // "": the output's
    int bits = 6;
};

/// Makes a table from what is in the boxes, writes it, and says how much of each class it gets back. Throws
/// ConfigurationError; the table that was there is left then.
int teach_colours(const TeachColoursOptions& options);

}  // namespace goalmouth
