#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace goalmouth {

// Numbers of a command line. CLI11's own checks let NaN pass, and say bounds with 300 digits.

inline std::optional<double> finite_number(const std::string& text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

inline CLI::Validator any_number() {
    return {[](std::string& text) {
                return finite_number(text) ? std::string() : "'" + text + "' is not a number";
            },
            ""};
}

inline CLI::Validator positive_number() {
    return {[](std::string& text) {
                const auto value = finite_number(text);
                return value && *value > 0.0 ? std::string() : "'" + text + "' is not a number above 0";
            },
            ""};
}

}  // namespace goalmouth
