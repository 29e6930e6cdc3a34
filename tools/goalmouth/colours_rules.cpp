#include "tools/goalmouth/colours_rules.h"

#include "core/imaging/image_file.h"
#include "core/process/configuration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <yaml-cpp/yaml.h>

namespace goalmouth {

namespace {

struct Bound {
    std::string_view key;
    Interval ColourRule::*interval;
    double lowest;
    double highest;
    std::string_view unit;
};

constexpr std::array<Bound, 6> bounds = {
    {{"y", &ColourRule::y, 0, 255, "levels"},
     {"cb", &ColourRule::cb, 0, 255, "levels"},
     {"cr", &ColourRule::cr, 0, 255, "levels"},
     {"hue", &ColourRule::hue, 0, 360, "degrees"},
     {"chroma", &ColourRule::chroma, 0, 182, "levels"},
     {"saturation", &ColourRule::saturation, 0, 182, "chroma for each level of luma"}}};

[[noreturn]] void fail(const std::filesystem::path& file, const YAML::Mark& mark, const std::string& what) {
    const std::string line = mark.line >= 0 ? ":" + std::to_string(mark.line + 1) : "";
    throw ConfigurationError(file.string() + line + ": " + what);
}

std::string shown(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

Interval read_interval(const std::filesystem::path& file, const YAML::Node& node, const Bound& bound) {
    const std::string wanted = "\"" + std::string(bound.key) + "\" must be [lowest, highest], numbers in " +
                               shown(bound.lowest) + "…" + shown(bound.highest) + " (" +
                               std::string(bound.unit) + ")";
    if (!node.IsSequence() || node.size() != 2) fail(file, node.Mark(), wanted);
    Interval interval;
    try {
        interval = {node[0].as<double>(), node[1].as<double>()};
    } catch (const YAML::Exception&) {
        fail(file, node.Mark(), wanted);
    }
    for (const double value : {interval.lowest, interval.highest})
        if (!(value >= bound.lowest && value <= bound.highest)) fail(file, node.Mark(), wanted);
    if (interval.lowest > interval.highest && bound.key != "hue")
        fail(file, node.Mark(), wanted + ", the lowest first");
    return interval;
}

ColourRule read_rule(const std::filesystem::path& file, const YAML::Node& node) {
    if (!node.IsMap()) fail(file, node.Mark(), "a rule must be a map, e.g. {class: goal, hue: [150, 190]}");
    ColourRule rule;
    bool has_class = false;
    for (const auto& entry : node) {
        const auto key = entry.first.as<std::string>();
        if (key == "class") {
            const auto name = entry.second.as<std::string>("");
            const auto found = std::find(colour_names.begin(), colour_names.end(), name);
            if (found == colour_names.end()) {
                std::string known;
                for (const auto colour : colour_names) known.append(known.empty() ? "" : ", ").append(colour);
                fail(file, entry.second.Mark(), "unknown class \"" + name + "\"; valid: " + known);
            }
            rule.colour = static_cast<Colour>(found - colour_names.begin());
            has_class = true;
            continue;
        }
        const auto bound =
            std::find_if(bounds.begin(), bounds.end(), [&](const Bound& b) { return b.key == key; });
        if (bound == bounds.end())
            fail(file, entry.first.Mark(),
                 "unknown key \"" + key + "\" in a rule; valid: class, y, cb, cr, hue, chroma, saturation");
        rule.*(bound->interval) = read_interval(file, entry.second, *bound);
    }
    if (!has_class) fail(file, node.Mark(), "a rule without \"class\"");
    return rule;
}

}  // namespace

ColourRuleFile load_colour_rules(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = read_bytes(file);
    ColourRuleFile out;
    out.name = file.stem().string();
    try {
        const YAML::Node root = YAML::Load(std::string(bytes.begin(), bytes.end()));
        if (!root.IsMap()) fail(file, root.Mark(), "not a rule file: expected the keys name, bits and rules");
        for (const auto& entry : root) {
            const auto key = entry.first.as<std::string>();
            const YAML::Node& value = entry.second;
            if (key == "name") {
                out.name = value.as<std::string>();
            } else if (key == "bits") {
                out.bits = value.as<int>(0);
                if (out.bits < 5 || out.bits > 8) fail(file, value.Mark(), "\"bits\" must be 5, 6, 7 or 8");
            } else if (key == "rules") {
                if (!value.IsSequence()) fail(file, value.Mark(), "\"rules\" must be a list");
                for (const auto& rule : value) out.rules.push_back(read_rule(file, rule));
            } else {
                fail(file, entry.first.Mark(), "unknown key \"" + key + "\"; valid: name, bits, rules");
            }
        }
    } catch (const YAML::Exception& error) {
        fail(file, error.mark, error.msg);
    }
    if (out.rules.empty())
        throw ConfigurationError(file.string() + ": holds no rule: expected a list \"rules\"");
    return out;
}

}  // namespace goalmouth
