#pragma once

#include "core/imaging/image_file.h"
#include "core/imaging/yuyv.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace goalmouth {

/// A picture to learn from, as it came.
struct NamedPicture {
    std::string name;  // for people
    YuyvImage image;
    std::filesystem::path file;        // as it was named
    std::optional<std::size_t> place;  // in a log: its number among the pictures there, from 0
};

/// Pictures, folders of them and LCM logs (their self-contained frames), in the order they are named; of more
/// than `most` in all, so many evenly spread. `size`: of raw pictures. Throws ConfigurationError where one
/// cannot be read or a log holds none.
std::vector<NamedPicture> learning_pictures(const std::vector<std::string>& named,
                                            std::optional<ImageSize> size, std::size_t most);

/// A picture's own file. `size`: if it is raw. Throws FileError.
NamedPicture picture_of_file(const std::filesystem::path& file, std::optional<ImageSize> size);

/// Those of a log with these places, in their order. Throws ConfigurationError where the log cannot be read
/// or has not so many.
std::vector<NamedPicture> pictures_of_log(const std::filesystem::path& log,
                                          const std::set<std::size_t>& places);

/// Whether the file begins as LCM logs do.
bool is_log_file(const std::filesystem::path& file);

}  // namespace goalmouth
