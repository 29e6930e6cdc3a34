#pragma once

#include "core/imaging/image_file.h"
#include "core/imaging/yuyv.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// A picture to learn from, as it came.
struct NamedPicture {
    std::string name;  // for people
    YuyvImage image;
};

/// Pictures, folders of them and LCM logs (their self-contained frames), in the order they are named; of more
/// than `most` in all, so many evenly spread. `size`: of raw pictures. Throws ConfigurationError where one
/// cannot be read or a log holds none.
std::vector<NamedPicture> learning_pictures(const std::vector<std::string>& named,
                                            std::optional<ImageSize> size, std::size_t most);

}  // namespace goalmouth
