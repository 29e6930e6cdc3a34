#include "core/imaging/image_file.h"

#include "core/imaging/conversion.h"
#include "core/imaging/file_error.h"
#include "core/imaging/jpeg.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <opencv2/imgcodecs.hpp>

namespace goalmouth {

namespace {

constexpr int largest_side = 16384;

std::string text_of(ImageSize size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

std::string lower_extension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::optional<int> parse_side(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < 1 || value > largest_side)
        return std::nullopt;
    return value;
}

YuyvImage raw_image(const std::filesystem::path& file, std::vector<std::uint8_t> bytes,
                    std::optional<ImageSize> size) {
    if (!size) {
        throw FileError(file.string() +
                        ": a raw 4:2:2 image does not say how large it is: give its size (--size 640x480)");
    }
    YuyvImage image(size->width, size->height);
    if (bytes.size() != image.data.size()) {
        throw FileError(file.string() + ": holds " + std::to_string(bytes.size()) +
                        " bytes, but a raw 4:2:2 image of " + text_of(*size) + " has " +
                        std::to_string(image.data.size()));
    }
    image.data = std::move(bytes);
    return image;
}

bool is_jpeg(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

/// Straight to YCbCr: what a camera compressed comes back without a detour over RGB.
YuyvImage jpeg_image(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
    try {
        return yuyv_from_jpeg(bytes);
    } catch (const std::runtime_error& error) {
        throw FileError(file.string() + ": a JPEG that cannot be read: " + error.what());
    }
}

YuyvImage checked(const std::filesystem::path& file, YuyvImage image, std::optional<ImageSize> size) {
    if (size && *size != ImageSize{image.width, image.height}) {
        throw FileError(file.string() + ": is " + text_of({image.width, image.height}) + ", but " +
                        text_of(*size) + " is expected");
    }
    return image;
}

}  // namespace

std::optional<ImageSize> parse_image_size(const std::string& text) {
    const std::size_t cross = text.find('x');
    if (cross == std::string::npos) return std::nullopt;
    const auto width = parse_side(std::string_view(text).substr(0, cross));
    const auto height = parse_side(std::string_view(text).substr(cross + 1));
    if (!width || !height) return std::nullopt;
    return ImageSize{*width, *height};
}

bool is_raw_image_name(const std::filesystem::path& file) {
    const std::string extension = lower_extension(file);
    return extension == ".yuyv" || extension == ".yuv" || extension == ".raw";
}

bool is_image_name(const std::filesystem::path& file) {
    static constexpr std::string_view known[] = {".png", ".jpg", ".jpeg", ".ppm", ".pgm", ".pnm", ".bmp"};
    const std::string extension = lower_extension(file);
    return is_raw_image_name(file) ||
           std::find(std::begin(known), std::end(known), extension) != std::end(known);
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) throw FileError(file.string() + ": no such file");
    if (!std::filesystem::is_regular_file(status)) throw FileError(file.string() + ": not a file");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw FileError(file.string() + ": cannot be opened: " + std::strerror(errno));
    std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    if (in.bad()) throw FileError(file.string() + ": cannot be read to its end");
    if (bytes.empty()) throw FileError(file.string() + ": is empty (0 bytes)");
    return bytes;
}

YuyvImage read_image(const std::filesystem::path& file, std::optional<ImageSize> size) {
    std::vector<std::uint8_t> bytes = read_bytes(file);
    if (is_raw_image_name(file)) return raw_image(file, std::move(bytes), size);
    if (is_jpeg(bytes)) return checked(file, jpeg_image(file, bytes), size);
    cv::Mat bgr;
    try {
        bgr = cv::imdecode(bytes, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
    } catch (const cv::Exception&) {
        bgr.release();
    }
    if (bgr.empty()) {
        throw FileError(file.string() + ": " + std::to_string(bytes.size()) +
                        " bytes that are no image, or a damaged one (expected PNG, JPEG or PPM; raw 4:2:2 is "
                        "named .yuyv)");
    }
    if (bgr.cols > largest_side || bgr.rows > largest_side) {
        throw FileError(file.string() + ": is " + text_of({bgr.cols, bgr.rows}) + ", larger than " +
                        text_of({largest_side, largest_side}));
    }
    return checked(file, yuyv_from_bgr(bgr), size);
}

void write_bytes(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
    std::error_code ignored;
    const auto status = std::filesystem::status(file, ignored);
    const bool device = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
                        !std::filesystem::is_directory(status);
    std::filesystem::path target = file;
    if (!device && std::filesystem::is_symlink(file, ignored))
        target = file.parent_path() / std::filesystem::read_symlink(file, ignored);
    std::filesystem::path partial = target;
    if (!device) partial += ".partial";
    std::ofstream out(partial, std::ios::binary | std::ios::trunc);
    if (!out) throw FileError(file.string() + ": cannot be written: " + std::strerror(errno));
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.close();
    std::error_code error;
    if (out) {
        if (!device) std::filesystem::rename(partial, target, error);
    } else {
        error = std::make_error_code(std::errc::io_error);
    }
    if (error) {
        if (!device) std::filesystem::remove(partial, ignored);
        throw FileError(file.string() + ": cannot be written: " + error.message());
    }
}

void write_yuyv(const std::filesystem::path& file, YuyvView image) {
    std::vector<std::uint8_t> bytes;
    const int row_bytes = yuyv_row_bytes(image.width);
    bytes.reserve(static_cast<std::size_t>(row_bytes) * static_cast<std::size_t>(image.height));
    for (int y = 0; y < image.height; ++y) bytes.insert(bytes.end(), image.row(y), image.row(y) + row_bytes);
    write_bytes(file, bytes);
}

}  // namespace goalmouth
