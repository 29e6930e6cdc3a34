#include "tools/goalmouth/output.h"

#include "core/imaging/file_error.h"
#include "core/imaging/image_file.h"
#include "core/process/configuration.h"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <span>
#include <system_error>
#include <unistd.h>
#include <vector>

#include <opencv2/imgcodecs.hpp>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& option, const std::string& what) {
    throw ConfigurationError(option.empty() ? what : option + ": " + what);
}

void write(const fs::path& file, std::span<const std::uint8_t> bytes, const std::string& option) {
    try {
        write_bytes(file, bytes);
    } catch (const FileError& error) {
        fail(option, error.what());
    }
}

}  // namespace

void make_output_folder(const fs::path& folder, const std::string& option) {
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (!problem && !fs::is_directory(folder)) problem = std::make_error_code(std::errc::not_a_directory);
    if (problem) fail(option, "the folder " + folder.string() + " cannot be made: " + problem.message());
}

void expect_writable(const fs::path& file, const std::string& option) {
    std::error_code ignored;
    if (fs::is_directory(file, ignored))
        fail(option, file.string() + ": is a folder, expected a file's name");
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (::access(folder.c_str(), W_OK | X_OK) != 0 && ::access(file.c_str(), W_OK) != 0)
        fail(option, file.string() + ": cannot be written: " + folder.string() + ": " + std::strerror(errno));
}

void write_text(const fs::path& file, const std::string& text, const std::string& option) {
    write(file, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, option);
}

void write_picture(const fs::path& file, const cv::Mat& picture, const std::string& option) {
    std::vector<std::uint8_t> bytes;
    bool encoded = false;
    try {
        encoded = cv::imencode(file.extension().string(), picture, bytes);
    } catch (const cv::Exception&) {
        encoded = false;
    }
    if (!encoded)
        fail(option, file.string() + ": cannot be written: its name must end in .png, .jpg or .ppm");
    write(file, bytes, option);
}

}  // namespace goalmouth
