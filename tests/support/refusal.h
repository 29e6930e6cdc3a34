#pragma once

#include "core/process/configuration.h"

#include <string>

namespace goalmouth::test {

/// What `work` says of a mistake of its user's, "nothing was thrown" where it finds none. Any other exception
/// goes through.
template <class Work>
std::string message_of(const Work& work) {
    try {
        work();
    } catch (const ConfigurationError& error) {
        return error.what();
    }
    return "nothing was thrown";
}

}  // namespace goalmouth::test
