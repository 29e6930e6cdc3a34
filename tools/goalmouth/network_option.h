#pragma once

#include "core/process/launcher.h"

#include <string>

#include <CLI/CLI.hpp>

namespace goalmouth {

/// --network, the same for every verb that runs a graph.
inline void add_network_option(CLI::App& verb, std::string& word) {
    verb.add_option("--network", word,
                    "host: the host's own; private: one for this graph alone; auto: private where the host "
                    "carries no multicast")
        ->check(CLI::IsMember({"auto", "host", "private"}))
        ->capture_default_str();
}

inline NetworkChoice network_choice(const std::string& word) {
    if (word == "host") return NetworkChoice::host;
    return word == "private" ? NetworkChoice::separate : NetworkChoice::automatic;
}

}  // namespace goalmouth
