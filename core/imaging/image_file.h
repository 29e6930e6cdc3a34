#pragma once

#include "core/imaging/yuyv.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace goalmouth {

struct ImageSize {
    int width = 0;   // px
    int height = 0;  // px
    bool operator==(const ImageSize&) const = default;
};

/// "640x480"; nothing where the text is not two numbers in 1…16384 with an x between them.
std::optional<ImageSize> parse_image_size(const std::string& text);

/// Reads PNG, JPEG, PPM/PGM and what else OpenCV reads, or a raw 4:2:2 image where the name ends in .yuyv
/// (.yuv, .raw): that one needs `size`. For the others a given size is checked. Throws FileError.
YuyvImage read_image(const std::filesystem::path& file, std::optional<ImageSize> size = std::nullopt);

/// Gives memory for an image of that size, rows packed: yuyv_row_bytes(width)·height bytes.
using ImageMemory = std::function<std::span<std::uint8_t>(ImageSize)>;

/// The same into memory of the caller's, asked for once the size is known. A raw image is read straight into
/// it. After a FileError the memory holds nothing of use.
ImageSize read_image(const std::filesystem::path& file, std::optional<ImageSize> size,
                     const ImageMemory& memory);

/// True where read_image would try by the name alone.
bool is_image_name(const std::filesystem::path& file);
bool is_raw_image_name(const std::filesystem::path& file);

/// The whole file. Throws FileError, also where it is empty or not a regular file.
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file);

/// Raw 4:2:2, rows packed: what read_image takes for .yuyv. Throws FileError.
void write_yuyv(const std::filesystem::path& file, YuyvView image);

/// Writes through `file`.partial and a rename, so that nobody ever sees half a file; through a link to
/// what it names, and straight into a device or pipe. Throws FileError.
void write_bytes(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

}  // namespace goalmouth
