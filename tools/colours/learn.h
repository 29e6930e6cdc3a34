#pragma once

#include "core/imaging/image_file.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

struct LearnColoursOptions {
    std::vector<std::string> pictures;  // files, folders, logs
    std::optional<ImageSize> size;      // of raw pictures
    std::filesystem::path field;        // "": KidSize 2013
    std::filesystem::path output;
    std::filesystem::path report;  // "": none
    std::string name;              // "": the output's
    std::size_t most = 40;         // pictures
    int bits = 6;
};

/// Learns a table without labels, writes it, and says what it was learnt from and how far to trust it. Throws
/// ConfigurationError; the table that was there is left then.
int learn_colours(const LearnColoursOptions& options);

}  // namespace goalmouth
