#pragma once

#include "core/process/graph.h"
#include "core/process/run_module.h"

#include <string>
#include <vector>

namespace goalmouth {

/// Every module class that is part of goalmouth, so that a tool can run a graph's modules inside itself.
const std::vector<ModuleType>& module_types();

/// By the name of its program; nullptr for programs that are not ours.
const ModuleType* find_module_type(const std::string& executable);

/// For GraphOptions::describe: describes the modules above without starting their programs.
bool describe_module(const std::string& executable, ProgramDescription& description);

}  // namespace goalmouth
