#pragma once

#include "tests/support/files.h"

#include <cstdlib>
#include <filesystem>
#include <string>

namespace goalmouth::test {

/// $PATH for the time of a test.
class PathVariable {
  public:
    explicit PathVariable(const std::string& value) : before_(std::getenv("PATH")) {
        ::setenv("PATH", value.c_str(), 1);
    }
    ~PathVariable() { ::setenv("PATH", before_.c_str(), 1); }
    PathVariable(const PathVariable&) = delete;
    PathVariable& operator=(const PathVariable&) = delete;

  private:
    std::string before_;
};

/// A program `folder`/`name` that runs a shell script.
inline void write_program(const std::filesystem::path& folder, const std::string& name,
                          const std::string& script) {
    write_text(folder / name, "#!/bin/sh\n" + script);
    std::filesystem::permissions(folder / name, std::filesystem::perms::owner_all);
}

}  // namespace goalmouth::test
