#pragma once

#include "core/process/graph.h"

#include <filesystem>
#include <string>

namespace goalmouth {

/// The program that `executable` names: a path (relative ones count from `folder`), a program beside the
/// running one, or one on PATH. Throws ConfigurationError that says where was looked; `where` stands in
/// front.
std::filesystem::path find_program(const std::string& executable, const std::filesystem::path& folder,
                                   const std::string& where);

/// Runs `program --describe` and reads what it answers. Throws ConfigurationError where it does not answer.
ProgramDescription ask_program(const std::filesystem::path& program, const std::string& where);

/// Reads the answer to --describe. Throws std::runtime_error where it is not one.
ProgramDescription parse_description(const std::string& text);

}  // namespace goalmouth
