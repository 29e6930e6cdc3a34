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

std::size_t bytes_of(ImageSize size) {
    return static_cast<std::size_t>(yuyv_row_bytes(size.width)) * static_cast<std::size_t>(size.height);
}

/// An open file and how long it is.
struct OpenFile {
    std::ifstream in;
    std::size_t size = 0;
};

OpenFile opened(const std::filesystem::path& file) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) throw FileError(file.string() + ": no such file");
    if (!std::filesystem::is_regular_file(status)) throw FileError(file.string() + ": not a file");
    OpenFile opened_file{std::ifstream(file, std::ios::binary), std::filesystem::file_size(file, error)};
    if (!opened_file.in) throw FileError(file.string() + ": cannot be opened: " + std::strerror(errno));
    if (error) throw FileError(file.string() + ": its size cannot be asked: " + error.message());
    if (opened_file.size == 0) throw FileError(file.string() + ": is empty (0 bytes)");
    return opened_file;
}

void read_whole(const std::filesystem::path& file, OpenFile& from, std::span<std::uint8_t> to) {
    from.in.read(reinterpret_cast<char*>(to.data()), static_cast<std::streamsize>(to.size()));
    if (from.in.gcount() != static_cast<std::streamsize>(to.size()))
        throw FileError(file.string() + ": cannot be read to its end");
}

ImageSize read_raw_image(const std::filesystem::path& file, std::optional<ImageSize> size,
                         const ImageMemory& memory) {
    OpenFile from = opened(file);
    if (!size) {
        throw FileError(file.string() +
                        ": a raw 4:2:2 image does not say how large it is: give its size (--size 640x480)");
    }
    if (from.size != bytes_of(*size)) {
        throw FileError(file.string() + ": holds " + std::to_string(from.size) +
                        " bytes, but a raw 4:2:2 image of " + text_of(*size) + " has " +
                        std::to_string(bytes_of(*size)));
    }
    read_whole(file, from, memory(*size));
    return *size;
}

bool is_jpeg(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

void check_size(const std::filesystem::path& file, ImageSize is, std::optional<ImageSize> expected) {
    if (expected && *expected != is)
        throw FileError(file.string() + ": is " + text_of(is) + ", but " + text_of(*expected) +
                        " is expected");
}

/// Straight to YCbCr: what a camera compressed comes back without a detour over RGB.
ImageSize read_jpeg_image(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                          std::optional<ImageSize> size, const ImageMemory& memory) {
    try {
        JpegDecoder decoder;
        const auto [width, height] = decoder.size_of(bytes);
        check_size(file, {width, height}, size);
        decoder.decode(bytes, memory({width, height}));
        return {width, height};
    } catch (const FileError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw FileError(file.string() + ": a JPEG that cannot be read: " + error.what());
    }
}

/// The file that a chain of symbolic links names, which need not be there yet.
std::filesystem::path end_of_links(const std::filesystem::path& file) {
    constexpr int most_links = 40;  // as many as the kernel follows
    std::filesystem::path end = file;
    std::error_code error;
    for (int i = 0; std::filesystem::is_symlink(end, error); ++i) {
        if (i == most_links) throw FileError(file.string() + ": cannot be written: its links never end");
        end = end.parent_path() / std::filesystem::read_symlink(end, error);
        if (error) throw FileError(file.string() + ": cannot be written: " + error.message());
    }
    return end;
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
    OpenFile from = opened(file);
    std::vector<std::uint8_t> bytes(from.size);
    read_whole(file, from, bytes);
    return bytes;
}

YuyvImage read_image(const std::filesystem::path& file, std::optional<ImageSize> size) {
    YuyvImage image;
    read_image(file, size, [&](ImageSize is) {
        image = YuyvImage(is.width, is.height);
        return std::span(image.data);
    });
    return image;
}

ImageSize read_image(const std::filesystem::path& file, std::optional<ImageSize> size,
                     const ImageMemory& memory) {
    if (is_raw_image_name(file)) return read_raw_image(file, size, memory);
    const std::vector<std::uint8_t> bytes = read_bytes(file);
    if (is_jpeg(bytes)) return read_jpeg_image(file, bytes, size, memory);
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
    const ImageSize is{bgr.cols, bgr.rows};
    check_size(file, is, size);
    yuyv_from_bgr(bgr, memory(is));
    return is;
}

void write_bytes(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
    std::error_code ignored;
    const auto status = std::filesystem::status(file, ignored);
    const bool device = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
                        !std::filesystem::is_directory(status);
    const std::filesystem::path target = device ? file : end_of_links(file);
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
