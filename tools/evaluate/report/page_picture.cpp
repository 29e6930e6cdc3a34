#include "core/imaging/file_error.h"
#include "core/imaging/image_file.h"
#include "core/process/configuration.h"
#include "tools/evaluate/report/html_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <span>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace goalmouth {
namespace {

std::string base64(std::span<const std::uint8_t> bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t there = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = static_cast<std::uint32_t>(bytes[i]) << 16;
        if (there > 1) group |= static_cast<std::uint32_t>(bytes[i + 1]) << 8;
        if (there > 2) group |= bytes[i + 2];
        text += digits[group >> 18 & 63];
        text += digits[group >> 12 & 63];
        text += there > 1 ? digits[group >> 6 & 63] : '=';
        text += there > 2 ? digits[group & 63] : '=';
    }
    return text;
}

bool begins_with(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> magic) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

std::string uri_of(std::span<const std::uint8_t> bytes, const char* type) {
    return fmt::format("data:image/{};base64,{}", type, base64(bytes));
}

}  // namespace

PagePicture page_picture(const cv::Mat& picture, const std::string& caption, PictureFormat format,
                         int widest) {
    if (picture.empty() || picture.depth() != CV_8U || (picture.channels() != 3 && picture.channels() != 1))
        throw std::invalid_argument("a page's picture must be BGR or grey with 8 bits");
    if (widest < 1) throw std::invalid_argument("a page's picture must be at least 1 px wide");
    cv::Mat shown = picture;
    if (picture.cols > widest) {
        const int rows =
            std::max(1, static_cast<int>(std::lround(1.0 * picture.rows * widest / picture.cols)));
        cv::resize(picture, shown, {widest, rows}, 0.0, 0.0, cv::INTER_AREA);
    }
    std::vector<std::uint8_t> bytes;
    const bool encoded = format == PictureFormat::png
                             ? cv::imencode(".png", shown, bytes)
                             : cv::imencode(".jpg", shown, bytes, {cv::IMWRITE_JPEG_QUALITY, 85});
    if (!encoded) throw std::runtime_error("a page's picture could not be encoded");
    return {
        uri_of(bytes, format == PictureFormat::png ? "png" : "jpeg"), shown.cols, shown.rows, caption, {}};
}

PagePicture page_picture(const std::filesystem::path& file, const std::string& caption) {
    static constexpr std::array<std::uint8_t, 8> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    static constexpr std::array<std::uint8_t, 3> jpeg{0xFF, 0xD8, 0xFF};
    std::vector<std::uint8_t> bytes;
    try {
        bytes = read_bytes(file);
    } catch (const FileError& error) {
        throw ConfigurationError(error.what());
    }
    const char* type = begins_with(bytes, png) ? "png" : begins_with(bytes, jpeg) ? "jpeg" : nullptr;
    const cv::Mat decoded =
        type == nullptr ? cv::Mat() : cv::imdecode(bytes, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
    if (decoded.empty())
        throw ConfigurationError(file.string() + ": is no PNG or JPEG picture that can be read");
    return {uri_of(bytes, type), decoded.cols, decoded.rows, caption, {}};
}

}  // namespace goalmouth
