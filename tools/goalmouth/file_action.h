#pragma once

#include "core/imaging/file_error.h"
#include "core/process/configuration.h"
#include "tools/goalmouth/verbs.h"

#include <filesystem>

#include <CLI/CLI.hpp>

namespace goalmouth {

/// A file the command line named and that cannot be used is the user's to mend.
template <class F>
void sets_action(CLI::App* command, Action& action, F run) {
    command->callback([&action, run] {
        action = [run] {
            try {
                return run();
            } catch (const FileError& error) {
                throw ConfigurationError(error.what());
            } catch (const std::filesystem::filesystem_error& error) {
                throw ConfigurationError(error.what());
            }
        };
    });
}

}  // namespace goalmouth
