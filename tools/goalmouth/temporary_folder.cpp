#include "tools/goalmouth/temporary_folder.h"

#include "core/process/configuration.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace goalmouth {

TemporaryFolder::TemporaryFolder(const std::filesystem::path& place, const std::string& prefix,
                                 const std::string& option) {
    std::string name = (place / (prefix + "XXXXXX")).string();
    if (::mkdtemp(name.data()) == nullptr)
        throw ConfigurationError((option.empty() ? "" : option + ": ") + "the folder " + place.string() +
                                 " cannot be written: " + std::strerror(errno));
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace goalmouth
