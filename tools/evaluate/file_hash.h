#pragma once

#include <filesystem>
#include <string>

namespace goalmouth {

/// 64-bit FNV-1a of a file's bytes as 16 hexadecimal digits: tells two files of the same name apart. Throws
/// FileError.
std::string file_hash(const std::filesystem::path& file);

}  // namespace goalmouth
