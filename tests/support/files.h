#pragma once

#include "core/imaging/image_file.h"

#include <cstdint>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace goalmouth::test {

/// A file that holds `content`.
inline void write_text(const std::filesystem::path& file, const std::string& content) {
    write_bytes(file, {reinterpret_cast<const std::uint8_t*>(content.data()), content.size()});
}

/// What a file holds; it must be there and not be empty.
inline std::string read_text(const std::filesystem::path& file) {
    const auto bytes = read_bytes(file);
    return {bytes.begin(), bytes.end()};
}

/// A picture of one grey; its format is that of the file's extension.
inline void write_grey_picture(const std::filesystem::path& file, int grey, int width, int height) {
    ASSERT_TRUE(cv::imwrite(file.string(), cv::Mat(height, width, CV_8UC3, cv::Scalar::all(grey)))) << file;
}

}  // namespace goalmouth::test
