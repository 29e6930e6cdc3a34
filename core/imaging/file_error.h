#pragma once

#include <stdexcept>

namespace goalmouth {

/// A file that cannot be used: a sentence with the file, what was found and what was expected. Whoever read
/// the file because a configuration named it says so to the user as a configuration error.
class FileError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace goalmouth
