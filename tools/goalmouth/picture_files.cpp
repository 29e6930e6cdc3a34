#include "tools/goalmouth/picture_files.h"

#include "core/imaging/image_file.h"
#include "core/process/configuration.h"

#include <algorithm>
#include <filesystem>

namespace goalmouth {

namespace fs = std::filesystem;

std::vector<std::string> picture_files(const std::vector<std::string>& named) {
    std::vector<std::string> files;
    for (const auto& name : named) {
        if (!fs::is_directory(name)) {
            files.push_back(name);
            continue;
        }
        std::vector<std::string> inside;
        for (const auto& entry : fs::directory_iterator(name)) {
            if (entry.is_regular_file() && is_image_name(entry.path()))
                inside.push_back(entry.path().string());
        }
        std::sort(inside.begin(), inside.end());
        if (inside.empty()) throw ConfigurationError(name + ": there is no picture in this folder");
        files.insert(files.end(), inside.begin(), inside.end());
    }
    return files;
}

}  // namespace goalmouth
