#pragma once

#include <filesystem>
#include <string>

namespace goalmouth {

/// A new empty folder, removed with all it holds when the object goes.
class TemporaryFolder {
  public:
    /// In `place`, its name beginning with `prefix`. Throws ConfigurationError, which begins with `option`
    /// where it is not empty and names the place.
    explicit TemporaryFolder(const std::filesystem::path& place = std::filesystem::temp_directory_path(),
                             const std::string& prefix = "goalmouth-", const std::string& option = "");
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace goalmouth
