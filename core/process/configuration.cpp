#include "core/process/configuration.h"

#include "core/process/text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <optional>
#include <set>
#include <sstream>

#include <yaml-cpp/yaml.h>

namespace goalmouth {
namespace {

struct Override {
    std::string key;
    YAML::Node value;
    std::string origin;
    std::filesystem::path folder;
};

std::string line_of(const std::string& name, const YAML::Mark& mark) {
    return mark.is_null() ? name : name + ":" + std::to_string(mark.line + 1);
}

}  // namespace

struct Configuration::Data {
    std::string name;  // stands for the file in errors
    std::filesystem::path folder;
    YAML::Node root;
    std::vector<Override> overrides;
};

Configuration::Configuration() : data_(std::make_shared<Data>()) {}
Configuration::~Configuration() = default;
Configuration::Configuration(const Configuration&) = default;
Configuration& Configuration::operator=(const Configuration&) = default;

Configuration Configuration::from_text(const std::string& text, const std::string& name,
                                       const std::filesystem::path& folder) {
    auto data = std::make_shared<Data>();
    data->name = name;
    data->folder = folder;
    try {
        data->root = YAML::Load(text);
    } catch (const YAML::ParserException& error) {
        throw ConfigurationError(line_of(name, error.mark) + ": not YAML: " + error.msg);
    }
    if (!data->root.IsNull() && !data->root.IsMap()) {
        throw ConfigurationError(line_of(name, data->root.Mark()) + ": expected 'key: value' lines");
    }
    Configuration result;
    result.data_ = std::move(data);
    return result;
}

Configuration Configuration::from_file(const std::filesystem::path& file) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {
        throw ConfigurationError(file.string() + ": is a folder, expected a YAML file");
    }
    std::ifstream stream(file);
    if (!stream) throw ConfigurationError(file.string() + ": cannot be read; expected a YAML file");
    std::ostringstream text;
    text << stream.rdbuf();
    if (text.str().empty()) {
        throw ConfigurationError(file.string() + ": is empty (0 bytes); expected 'key: value' lines");
    }
    return from_text(text.str(), file.string(), std::filesystem::absolute(file).parent_path());
}

void Configuration::set(const std::string& key, const std::string& value, const std::string& origin,
                        const std::filesystem::path& folder) {
    auto data = std::make_shared<Data>(*data_);
    YAML::Node node;
    try {
        node = YAML::Load(value);
    } catch (const YAML::ParserException& error) {
        throw ConfigurationError(origin + ": " + key + ": not YAML: " + error.msg);
    }
    data->overrides.push_back({key, node, origin, folder});
    data_ = std::move(data);
}

/// A value, and where it stands.
struct Configuration::Found {
    YAML::Node node;
    std::string where;  // "file:line"
    std::filesystem::path folder;
};

std::optional<Configuration::Found> Configuration::find(const std::string& key) const {
    for (auto it = data_->overrides.rbegin(); it != data_->overrides.rend(); ++it) {
        if (it->key == key) return Found{it->value, it->origin, it->folder};
    }
    YAML::Node node = data_->root;
    for (const auto& part : split(key, '.')) {
        if (!node.IsMap()) return std::nullopt;
        const YAML::Node& map = node;
        const YAML::Node next = map[part];
        if (!next.IsDefined()) return std::nullopt;
        node.reset(next);
    }
    return Found{node, line_of(data_->name, node.Mark()), data_->folder};
}

std::string Configuration::text(const std::string& key) const {
    const auto found = find(key);
    return found && found->node.IsScalar() ? found->node.Scalar() : std::string();
}

namespace {

std::string resolved(const std::filesystem::path& path, const std::filesystem::path& folder) {
    return path.empty() || path.is_absolute() ? path.string() : (folder / path).lexically_normal().string();
}

}  // namespace

std::string Configuration::file(const std::string& key) const {
    const auto found = find(key);
    return found && found->node.IsScalar() ? resolved(found->node.Scalar(), found->folder) : std::string();
}

struct ParameterReader::State {
    using Found = Configuration::Found;

    Configuration configuration;
    std::shared_ptr<const Configuration::Data> data;
    std::vector<YAML::Node> groups;     // the map of each open group, undefined where the file has none
    std::vector<std::string> prefixes;  // "walk." for each open group
    std::vector<std::vector<std::string>> known;  // keys asked for in each open group
    std::set<std::string> known_full;             // "walk.speed"
    std::vector<std::string> errors;

    std::string full(const char* key) const { return prefixes.back() + key; }

    std::optional<Found> find(const char* key) {
        known.back().emplace_back(key);
        known_full.insert(full(key));
        return configuration.find(full(key));
    }

    void wrong(const Found& found, const char* key, const std::string& valid) {
        const std::string shown = found.node.IsScalar() ? "'" + found.node.Scalar() + "'"
                                  : found.node.IsNull() ? std::string("nothing")
                                                        : std::string("a list or group");
        errors.push_back(found.where + ": " + full(key) + ": " + shown + " is not " + valid);
    }

    /// Keys of an open group that nothing asked for.
    void check_unknown() {
        const YAML::Node& map = groups.back();
        if (!map.IsDefined() || map.IsNull()) return;
        if (!map.IsMap()) {
            errors.push_back(line_of(data->name, map.Mark()) + ": " +
                             prefixes.back().substr(0, prefixes.back().size() - 1) +
                             ": expected 'key: value' lines");
            return;
        }
        std::set<std::string> seen;
        for (const auto& entry : map) {
            const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
            const std::string where = line_of(data->name, entry.first.Mark());
            if (!seen.insert(key).second)
                errors.push_back(where + ": " + prefixes.back() + key + ": given twice");
            if (std::find(known.back().begin(), known.back().end(), key) == known.back().end()) {
                errors.push_back(where + ": unknown key '" + prefixes.back() + key + "'; " +
                                 suggestion(key, known.back()));
            }
        }
    }
};

ParameterReader::ParameterReader(const Configuration& configuration) : state_(std::make_unique<State>()) {
    state_->configuration = configuration;
    state_->data = configuration.data_;
    state_->groups.push_back(configuration.data_->root);
    state_->prefixes.emplace_back();
    state_->known.emplace_back();
}

ParameterReader::~ParameterReader() = default;

namespace {

std::string number_text(double value) {
    std::ostringstream out;
    out.precision(15);
    out << value;
    return out.str();
}

std::string range_text(const Range& range, const char* what) {
    const bool low = std::isfinite(range.lowest);
    const bool high = std::isfinite(range.highest);
    std::string text = what;
    if (low && high) return text + " in " + number_text(range.lowest) + "…" + number_text(range.highest);
    // `above` stores the next number: of 0, that is one nobody would recognise.
    if (low && range.lowest == std::numeric_limits<double>::denorm_min()) return text + " above 0";
    if (low) return text + " of at least " + number_text(range.lowest);
    if (high) return text + " of at most " + number_text(range.highest);
    return text;
}

std::string choice_text(const Choice& choice) {
    std::string text = "one of: ";
    for (std::size_t i = 0; i < choice.words.size(); ++i) text += (i ? ", " : "") + choice.words[i];
    return text;
}

bool fits(const Range& range, double value) {
    return std::isfinite(value) && value >= range.lowest && value <= range.highest;
}

template <class Number>
std::optional<Number> read_number(const YAML::Node& node) {
    Number value{};
    if (!node.IsScalar() || !YAML::convert<Number>::decode(node, value)) return std::nullopt;
    return value;
}

}  // namespace

void ParameterReader::operator()(const char* key, double& value, const Range& range, const char*,
                                 const char*) {
    const auto found = state_->find(key);
    if (!found) return;
    const auto number = read_number<double>(found->node);
    if (!number || !fits(range, *number)) return state_->wrong(*found, key, range_text(range, "a number"));
    value = *number;
}

void ParameterReader::operator()(const char* key, float& value, const Range& range, const char* unit,
                                 const char* meaning) {
    double wide = value;
    (*this)(key, wide, range, unit, meaning);
    value = static_cast<float>(wide);
}

void ParameterReader::operator()(const char* key, int& value, const Range& range, const char*, const char*) {
    const auto found = state_->find(key);
    if (!found) return;
    const auto number = read_number<int>(found->node);
    if (!number || !fits(range, *number))
        return state_->wrong(*found, key, range_text(range, "a whole number"));
    value = *number;
}

void ParameterReader::operator()(const char* key, std::vector<double>& value, const Range& range, const char*,
                                 const char*) {
    const auto found = state_->find(key);
    if (!found) return;
    const std::string valid = "a list of numbers" + range_text(range, "");
    if (!found->node.IsSequence()) return state_->wrong(*found, key, valid);
    std::vector<double> list;
    for (const auto& item : found->node) {
        const auto number = read_number<double>(item);
        if (!number || !fits(range, *number)) return state_->wrong(*found, key, valid);
        list.push_back(*number);
    }
    value = std::move(list);
}

void ParameterReader::operator()(const char* key, bool& value, const char*) {
    const auto found = state_->find(key);
    if (!found) return;
    bool read = false;
    if (!found->node.IsScalar() || !YAML::convert<bool>::decode(found->node, read)) {
        return state_->wrong(*found, key, "true or false");
    }
    value = read;
}

void ParameterReader::operator()(const char* key, std::string& value, const Choice& choice, const char*) {
    const auto found = state_->find(key);
    if (!found) return;
    if (!found->node.IsScalar() ||
        std::find(choice.words.begin(), choice.words.end(), found->node.Scalar()) == choice.words.end()) {
        return state_->wrong(*found, key, choice_text(choice));
    }
    value = found->node.Scalar();
}

void ParameterReader::operator()(const char* key, std::string& value, const File& file, const char*) {
    const auto found = state_->find(key);
    if (!found) return;
    if (!found->node.IsScalar() || (found->node.Scalar().empty() && !file.may_be_empty)) {
        return state_->wrong(*found, key, "the name of a file");
    }
    value = resolved(found->node.Scalar(), found->folder);
}

void ParameterReader::operator()(const char* key, std::string& value, const Text&, const char*) {
    const auto found = state_->find(key);
    if (!found) return;
    if (!found->node.IsScalar()) return state_->wrong(*found, key, "a text");
    value = found->node.Scalar();
}

void ParameterReader::enter(const char* key, const char*) {
    state_->known.back().emplace_back(key);
    const YAML::Node& map = state_->groups.back();
    YAML::Node inner(YAML::NodeType::Undefined);
    if (map.IsDefined() && map.IsMap()) {
        const YAML::Node value = map[key];
        if (value.IsDefined()) inner.reset(value);
    }
    state_->prefixes.push_back(state_->full(key) + ".");
    state_->groups.push_back(inner);
    state_->known.emplace_back();
}

void ParameterReader::leave() {
    state_->check_unknown();
    state_->groups.pop_back();
    state_->prefixes.pop_back();
    state_->known.pop_back();
}

void ParameterReader::finish() {
    state_->check_unknown();
    for (const auto& given : state_->data->overrides) {
        if (!state_->known_full.contains(given.key)) {
            state_->errors.push_back(
                given.origin + ": unknown key '" + given.key + "'; " +
                suggestion(given.key, {state_->known_full.begin(), state_->known_full.end()}));
        }
    }
    if (!state_->errors.empty()) throw ConfigurationError(state_->errors.front());
}

void ParameterLister::operator()(const char* key, double& value, const Range& range, const char* unit,
                                 const char* meaning) {
    parameters.push_back({prefix_ + key, number_text(value), range_text(range, "a number"), unit, meaning});
}

void ParameterLister::operator()(const char* key, float& value, const Range& range, const char* unit,
                                 const char* meaning) {
    std::ostringstream shortest;
    shortest << value;
    parameters.push_back({prefix_ + key, shortest.str(), range_text(range, "a number"), unit, meaning});
}

void ParameterLister::operator()(const char* key, int& value, const Range& range, const char* unit,
                                 const char* meaning) {
    parameters.push_back(
        {prefix_ + key, std::to_string(value), range_text(range, "a whole number"), unit, meaning});
}

void ParameterLister::operator()(const char* key, std::vector<double>& value, const Range& range,
                                 const char* unit, const char* meaning) {
    std::string text = "[";
    for (std::size_t i = 0; i < value.size(); ++i) text += (i ? ", " : "") + number_text(value[i]);
    parameters.push_back(
        {prefix_ + key, text + "]", "a list of numbers" + range_text(range, ""), unit, meaning});
}

void ParameterLister::operator()(const char* key, bool& value, const char* meaning) {
    parameters.push_back({prefix_ + key, value ? "true" : "false", "true or false", "", meaning});
}

namespace {

std::string yaml_text(const std::string& text) {
    YAML::Emitter out;
    out << text;
    return text.empty() ? "\"\"" : out.c_str();
}

}  // namespace

void ParameterLister::operator()(const char* key, std::string& value, const Choice& choice,
                                 const char* meaning) {
    parameters.push_back({prefix_ + key, yaml_text(value), choice_text(choice), "", meaning});
}

void ParameterLister::operator()(const char* key, std::string& value, const File&, const char* meaning) {
    parameters.push_back({prefix_ + key, yaml_text(value), "the name of a file", "", meaning});
}

void ParameterLister::operator()(const char* key, std::string& value, const Text&, const char* meaning) {
    parameters.push_back({prefix_ + key, yaml_text(value), "a text", "", meaning});
}

std::string parameters_as_yaml(const std::vector<ParameterInfo>& parameters) {
    std::ostringstream out;
    std::vector<std::string> open;
    for (const auto& p : parameters) {
        auto parts = split(p.key, '.');
        const std::string leaf = parts.back();
        parts.pop_back();
        std::size_t common = 0;
        while (common < parts.size() && common < open.size() && parts[common] == open[common]) ++common;
        for (std::size_t depth = common; depth < parts.size(); ++depth) {
            out << std::string(2 * depth, ' ') << parts[depth] << ":\n";
        }
        open = parts;
        const bool has_unit = !p.unit.empty() && p.unit != "1";
        out << std::string(2 * parts.size(), ' ') << leaf << ": " << p.value << "  # "
            << (has_unit ? "[" + p.unit + "] " : "") << p.meaning << " (" << p.valid << ")\n";
    }
    return out.str();
}

}  // namespace goalmouth
