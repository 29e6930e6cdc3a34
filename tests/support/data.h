#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace goalmouth::test {

/// Folder of the real images and logs: $GOALMOUTH_DATA, or shared/data beside the project; nothing on a
/// machine without.
std::optional<std::filesystem::path> data_folder();

/// A new empty folder, removed with all it holds when the object goes.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace goalmouth::test

/// First line of a test that needs the real data: declares `data` as their folder, or skips the test and says
/// why.
#define GOALMOUTH_NEEDS_DATA(data)                                                                          \
    const auto data##_found = goalmouth::test::data_folder();                                               \
    if (!data##_found) GTEST_SKIP() << "skipped: no real data: neither $GOALMOUTH_DATA nor ../shared/data"; \
    const std::filesystem::path data = *data##_found
