#include "core/process/graph_value.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include <yaml-cpp/yaml.h>

namespace goalmouth {
namespace {

constexpr std::string_view dots = "…";

struct Bounds {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    bool hold(double value) const { return std::isfinite(value) && value >= lowest && value <= highest; }
};

std::optional<double> number(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// What stands behind "a number": nothing where it is of no form we know.
std::optional<Bounds> bounds_of(std::string_view text) {
    Bounds bounds;
    if (text.empty()) return bounds;
    const auto behind = [&](std::string_view start) -> std::optional<std::string_view> {
        return text.starts_with(start) ? std::optional(text.substr(start.size())) : std::nullopt;
    };
    if (const auto range = behind(" in ")) {
        const auto middle = range->find(dots);
        if (middle == std::string_view::npos) return std::nullopt;
        const auto low = number(range->substr(0, middle));
        const auto high = number(range->substr(middle + dots.size()));
        if (!low || !high) return std::nullopt;
        return Bounds{*low, *high};
    }
    if (const auto rest = behind(" of at least ")) {
        const auto low = number(*rest);
        if (low) return Bounds{*low, bounds.highest};
    }
    if (const auto rest = behind(" above ")) {
        const auto low = number(*rest);
        if (low) return Bounds{std::nextafter(*low, bounds.highest), bounds.highest};
    }
    if (const auto rest = behind(" of at most ")) {
        const auto high = number(*rest);
        if (high) return Bounds{bounds.lowest, *high};
    }
    return std::nullopt;
}

template <class Number>
bool is_number(const YAML::Node& node, const Bounds& bounds) {
    Number value{};
    return node.IsScalar() && YAML::convert<Number>::decode(node, value) &&
           bounds.hold(static_cast<double>(value));
}

bool is_one_of(const std::string& word, std::string_view words) {
    while (!words.empty()) {
        const auto comma = words.find(", ");
        if (words.substr(0, comma) == word) return true;
        words = comma == std::string_view::npos ? std::string_view() : words.substr(comma + 2);
    }
    return false;
}

}  // namespace

bool value_is_valid(const std::string& value, const std::string& valid) {
    YAML::Node node;
    try {
        node = YAML::Load(value);
    } catch (const YAML::Exception&) {
        return false;
    }
    const std::string_view rule = valid;
    const auto numbers = [&](std::string_view kind, auto fits) {
        const auto bounds = bounds_of(rule.substr(kind.size()));
        return !bounds || fits(*bounds);
    };
    constexpr std::string_view any = "a number";
    constexpr std::string_view whole = "a whole number";
    constexpr std::string_view list = "a list of numbers";
    constexpr std::string_view words = "one of: ";
    if (rule.starts_with(any))
        return numbers(any, [&](const Bounds& b) { return is_number<double>(node, b); });
    if (rule.starts_with(whole))
        return numbers(whole, [&](const Bounds& b) { return is_number<int>(node, b); });
    if (rule.starts_with(list)) {
        return numbers(list, [&](const Bounds& b) {
            if (!node.IsSequence()) return false;
            for (const auto& item : node) {
                if (!is_number<double>(item, b)) return false;
            }
            return true;
        });
    }
    if (rule == "true or false") {
        bool flag = false;
        return node.IsScalar() && YAML::convert<bool>::decode(node, flag);
    }
    if (rule.starts_with(words))
        return node.IsScalar() && is_one_of(node.Scalar(), rule.substr(words.size()));
    if (rule == "the name of a file" || rule == "a text") return node.IsScalar();
    return true;
}

}  // namespace goalmouth
