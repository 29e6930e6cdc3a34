#pragma once

#include <filesystem>
#include <string>

#include <opencv2/core/mat.hpp>

namespace goalmouth {

// Where the verbs write to. All throw ConfigurationError, which begins with `option` where it is not empty.

/// Makes the folder and those above it.
void make_output_folder(const std::filesystem::path& folder, const std::string& option);

/// Says beforehand that `file` cannot be written, so that no long work is lost to a misspelt folder.
void expect_writable(const std::filesystem::path& file, const std::string& option);

/// The whole file or none of it (write_bytes).
void write_text(const std::filesystem::path& file, const std::string& text, const std::string& option);

/// The same for a picture; the name's ending says the format.
void write_picture(const std::filesystem::path& file, const cv::Mat& picture, const std::string& option);

}  // namespace goalmouth
