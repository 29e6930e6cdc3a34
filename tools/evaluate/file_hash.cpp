#include "tools/evaluate/file_hash.h"

#include "core/imaging/image_file.h"

#include <cstdint>
#include <fmt/format.h>

namespace goalmouth {

std::string file_hash(const std::filesystem::path& file) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const std::uint8_t byte : read_bytes(file)) hash = (hash ^ byte) * 0x100000001b3U;
    return fmt::format("{:016x}", hash);
}

}  // namespace goalmouth
