#include "tests/support/data.h"

#include <cstdlib>
#include <stdexcept>

namespace goalmouth::test {

std::optional<std::filesystem::path> data_folder() {
    std::error_code ignored;
    if (const char* named = std::getenv("GOALMOUTH_DATA")) {
        if (std::filesystem::is_directory(named, ignored)) return named;
        return std::nullopt;
    }
    const std::filesystem::path beside =
        std::filesystem::path(GOALMOUTH_SOURCE_DIR) / ".." / "shared" / "data";
    if (std::filesystem::is_directory(beside, ignored)) return beside.lexically_normal();
    return std::nullopt;
}

TemporaryFolder::TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "goalmouth-test-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace goalmouth::test
