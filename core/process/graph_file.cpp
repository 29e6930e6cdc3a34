#include "core/process/graph_file.h"

#include "core/process/text.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include <yaml-cpp/yaml.h>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_channel_name = 63;  // LCM_MAX_CHANNEL_NAME_LENGTH

[[noreturn]] void fail(const Place& place, const std::string& what) {
    throw ConfigurationError(place.text() + ": " + what);
}

const char* kind_of(const YAML::Node& node) {
    if (node.IsSequence()) return "a list";
    if (node.IsMap()) return "a group of keys";
    return node.IsNull() ? "nothing" : "a text";
}

/// One YAML file being read: nodes become values with their places, or an error that says what would be
/// valid.
class Reader {
  public:
    explicit Reader(const fs::path& file) : file_(file), folder_(fs::absolute(file).parent_path()) {}

    Place place(const YAML::Node& node) const {
        return {file_.string(), node.Mark().is_null() ? 0 : node.Mark().line + 1};
    }

    /// Checks the keys of a group: known ones, each once. Returns it.
    const YAML::Node& group(const YAML::Node& node, const std::string& what,
                            const std::vector<std::string>& valid) const {
        if (!node.IsMap()) {
            fail(place(node), what + ": expected 'key: value' lines, not " + kind_of(node) +
                                  (valid.empty() ? "" : "; " + suggestion("", valid)));
        }
        std::set<std::string> seen;
        for (const auto& entry : node) {
            const std::string key = text(entry.first, what, "a key").text;
            if (!valid.empty() && std::find(valid.begin(), valid.end(), key) == valid.end()) {
                fail(place(entry.first),
                     "unknown key '" + key + "' in " + what + "; " + suggestion(key, valid));
            }
            if (!seen.insert(key).second)
                fail(place(entry.first), "key '" + key + "' given twice in " + what);
        }
        return node;
    }

    PlacedText text(const YAML::Node& node, const std::string& key, const std::string& valid) const {
        if (!node.IsScalar()) fail(place(node), key + ": expected " + valid + ", not " + kind_of(node));
        return {node.Scalar(), place(node), folder_};
    }

    /// A text that is not empty.
    PlacedText word(const YAML::Node& node, const std::string& key, const std::string& valid) const {
        PlacedText found = text(node, key, valid);
        if (found.text.empty()) fail(found.place, key + ": expected " + valid + ", not an empty text");
        return found;
    }

    bool flag(const YAML::Node& node, const std::string& key) const {
        bool value = false;
        if (!node.IsScalar() || !YAML::convert<bool>::decode(node, value)) {
            fail(place(node), key + ": expected true or false, not " +
                                  (node.IsScalar() ? "'" + node.Scalar() + "'" : std::string(kind_of(node))));
        }
        return value;
    }

    const YAML::Node& list(const YAML::Node& node, const std::string& key, const std::string& of) const {
        if (!node.IsSequence())
            fail(place(node), key + ": expected a list of " + of + ", not " + kind_of(node));
        return node;
    }

    /// Every value below `node` as a setting: nested groups give dotted keys.
    void settings(const YAML::Node& node, const std::string& what, const std::string& prefix,
                  std::vector<GraphSetting>& all) const {
        if (node.IsNull() && prefix.empty()) return;
        for (const auto& entry : group(node, what, {})) {
            const std::string key = prefix + entry.first.Scalar();
            if (entry.second.IsMap()) {
                settings(entry.second, what + "." + entry.first.Scalar(), key + ".", all);
            } else {
                all.push_back({key, as_yaml(entry.second), place(entry.second), folder_});
            }
        }
    }

    const fs::path& folder() const { return folder_; }

  private:
    /// A value as one line of YAML. A quoted text stays a text ("5" is not 5).
    static std::string as_yaml(const YAML::Node& node) {
        if (node.IsScalar() && node.Tag() != "!") return node.Scalar();
        YAML::Emitter out;
        out.SetSeqFormat(YAML::Flow);
        out.SetMapFormat(YAML::Flow);
        if (node.IsScalar()) {
            out << YAML::DoubleQuoted << node.Scalar();
        } else {
            out << node;
        }
        return out.c_str();
    }

    fs::path file_;
    fs::path folder_;
};

std::vector<PlacedChannelUse> channel_uses(const Reader& reader, const YAML::Node& node,
                                           const std::string& key) {
    std::vector<PlacedChannelUse> uses;
    for (const auto& item : reader.list(node, key, "channels")) {
        PlacedChannelUse found{{}, reader.place(item)};
        if (item.IsMap()) {
            reader.group(item, key, {"channel", "type", "meaning", "optional"});
            if (!item["channel"].IsDefined()) fail(found.place, key + ": an entry has no 'channel'");
            found.use.channel = reader.word(item["channel"], key + ".channel", "the name of a channel").text;
            if (item["type"].IsDefined())
                found.use.type = reader.text(item["type"], key + ".type", "a message type").text;
            if (item["meaning"].IsDefined()) {
                found.use.meaning = reader.text(item["meaning"], key + ".meaning", "a sentence").text;
            }
            if (item["optional"].IsDefined())
                found.use.optional = reader.flag(item["optional"], key + ".optional");
        } else {
            found.use.channel = reader.word(item, key, "the name of a channel").text;
        }
        const std::string problem = channel_name_problem(found.use.channel);
        if (!problem.empty()) fail(found.place, key + ": " + problem);
        uses.push_back(std::move(found));
    }
    return uses;
}

ProcessEntry process_entry(const Reader& reader, const YAML::Node& node) {
    static const std::vector<std::string> valid = {"name",       "executable", "config",
                                                   "parameters", "channels",   "arguments",
                                                   "subscribes", "publishes",  "enabled"};
    const Place place = reader.place(node);
    reader.group(node, "an entry of processes", valid);
    ProcessEntry entry;
    entry.place = place;
    if (!node["name"].IsDefined())
        fail(place, "an entry of processes has no 'name'; valid: any name, e.g. 'name: detection'");
    entry.name = reader.word(node["name"], "name", "a name").text;
    const bool plain = std::all_of(entry.name.begin(), entry.name.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '-';
    });
    if (!plain) {
        fail(reader.place(node["name"]),
             "name: '" + entry.name + "' is not a name; valid: letters, digits, '_' and '-'");
    }
    const std::string of = entry.name + ": ";
    if (node["executable"].IsDefined()) {
        entry.executable = reader.word(node["executable"], of + "executable", "the name of a program");
    }
    if (node["config"].IsDefined())
        entry.config = reader.word(node["config"], of + "config", "the name of a file");
    if (node["parameters"].IsDefined())
        reader.settings(node["parameters"], of + "parameters", "", entry.parameters);
    if (node["channels"].IsDefined()) {
        for (const auto& item : reader.group(node["channels"], of + "channels", {})) {
            const PlacedText from = reader.text(item.first, of + "channels", "DEFAULT: NAME");
            const PlacedText to =
                reader.word(item.second, of + "channels." + from.text, "the name of a channel");
            const std::string problem = channel_name_problem(to.text);
            if (!problem.empty()) fail(to.place, of + "channels." + from.text + ": " + problem);
            entry.channels.emplace_back(from, to);
        }
    }
    if (node["arguments"].IsDefined()) {
        entry.arguments.emplace();
        for (const auto& item : reader.list(node["arguments"], of + "arguments", "texts")) {
            entry.arguments->push_back(reader.text(item, of + "arguments", "a text").text);
        }
    }
    if (node["subscribes"].IsDefined())
        entry.subscribes = channel_uses(reader, node["subscribes"], of + "subscribes");
    if (node["publishes"].IsDefined())
        entry.publishes = channel_uses(reader, node["publishes"], of + "publishes");
    if (node["enabled"].IsDefined()) entry.enabled = reader.flag(node["enabled"], of + "enabled");
    return entry;
}

void merge_settings(std::vector<GraphSetting>& base, std::vector<GraphSetting> over) {
    for (auto& setting : over) {
        std::erase_if(base, [&](const GraphSetting& old) { return old.key == setting.key; });
        base.push_back(std::move(setting));
    }
}

void merge_process(ProcessEntry& base, ProcessEntry over) {
    if (over.executable && (!base.executable || over.executable->text != base.executable->text)) {
        base = ProcessEntry{base.name, over.place, over.executable, {}, {}, std::move(base.channels), {}, {},
                            {},        {}};
    }
    base.place = over.place;
    if (over.config) base.config = std::move(over.config);
    merge_settings(base.parameters, std::move(over.parameters));
    for (auto& renamed : over.channels) {
        std::erase_if(base.channels, [&](const auto& old) { return old.first.text == renamed.first.text; });
        base.channels.push_back(std::move(renamed));
    }
    if (over.arguments) base.arguments = std::move(over.arguments);
    if (over.subscribes) base.subscribes = std::move(over.subscribes);
    if (over.publishes) base.publishes = std::move(over.publishes);
    if (over.enabled) base.enabled = over.enabled;
}

YAML::Node load_yaml(const fs::path& file) {
    std::error_code ignored;
    std::ifstream stream(file);
    if (!stream || fs::is_directory(file, ignored)) {
        throw ConfigurationError(file.string() + ": cannot be read; expected a graph file (YAML)");
    }
    std::ostringstream text;
    text << stream.rdbuf();
    try {
        return YAML::Load(text.str());
    } catch (const YAML::ParserException& error) {
        throw ConfigurationError(file.string() + ":" + std::to_string(error.mark.line + 1) +
                                 ": not YAML: " + error.msg);
    }
}

GraphFile read_with_bases(const fs::path& file, std::vector<fs::path> open);

/// The graph that `extends` names, to be laid over.
GraphFile base_graph(const PlacedText& extends, std::vector<fs::path> open) {
    const fs::path base = (extends.folder / extends.text).lexically_normal();
    std::error_code ignored;
    if (!fs::is_regular_file(base, ignored)) {
        fail(extends.place,
             "extends: " + base.string() + " does not exist; a path counts from the graph file");
    }
    const fs::path identity = fs::canonical(base);
    if (std::find(open.begin(), open.end(), identity) != open.end()) {
        std::string circle;
        for (const auto& step : open) circle += step.filename().string() + " → ";
        fail(extends.place, "extends: goes in a circle: " + circle + identity.filename().string());
    }
    return read_with_bases(base, std::move(open));
}

GraphFile read_with_bases(const fs::path& file, std::vector<fs::path> open) {
    static const std::vector<std::string> valid = {"name",   "seed",     "lcm_url",  "extends",
                                                   "common", "external", "processes"};
    const YAML::Node root = load_yaml(file);
    const Reader reader(file);
    if (root.IsNull()) throw ConfigurationError(file.string() + ": is empty; " + suggestion("", valid));
    reader.group(root, "the graph", valid);
    open.push_back(fs::canonical(file));

    GraphFile graph;
    if (root["extends"].IsDefined()) {
        graph =
            base_graph(reader.word(root["extends"], "extends", "the name of a graph file"), std::move(open));
    }
    graph.file = fs::absolute(file).lexically_normal();
    graph.name = file.stem().string();
    if (root["name"].IsDefined()) graph.name = reader.word(root["name"], "name", "a name").text;
    if (root["seed"].IsDefined()) {
        const PlacedText seed = reader.text(root["seed"], "seed", "a whole number of at least 0");
        std::uint64_t value = 0;
        if (seed.text.starts_with('-') || !YAML::convert<std::uint64_t>::decode(root["seed"], value)) {
            fail(seed.place, "seed: '" + seed.text + "' is not a whole number of at least 0");
        }
        graph.seed = value;
    }
    if (root["lcm_url"].IsDefined()) graph.lcm_url = reader.word(root["lcm_url"], "lcm_url", "an LCM URL");
    if (root["common"].IsDefined()) {
        std::vector<GraphSetting> common;
        reader.settings(root["common"], "common", "", common);
        merge_settings(graph.common, std::move(common));
    }
    if (root["external"].IsDefined()) {
        graph.external.clear();
        for (const auto& item : reader.list(root["external"], "external", "channels")) {
            graph.external.push_back(reader.word(item, "external", "the name of a channel"));
            const std::string problem = channel_name_problem(graph.external.back().text);
            if (!problem.empty()) fail(graph.external.back().place, "external: " + problem);
        }
    }
    std::set<std::string> names;
    if (root["processes"].IsDefined()) {
        for (const auto& node :
             reader.list(root["processes"], "processes", "entries, each with 'name' and 'executable'")) {
            ProcessEntry entry = process_entry(reader, node);
            if (!names.insert(entry.name).second) {
                fail(entry.place,
                     "name: '" + entry.name + "' is taken by another process; names must differ");
            }
            const auto known = std::find_if(graph.processes.begin(), graph.processes.end(),
                                            [&](const ProcessEntry& old) { return old.name == entry.name; });
            if (known == graph.processes.end()) {
                graph.processes.push_back(std::move(entry));
            } else {
                merge_process(*known, std::move(entry));
            }
        }
    }
    return graph;
}

}  // namespace

std::string channel_name_problem(const std::string& name) {
    if (name.size() > longest_channel_name)
        return "'" + name + "' is longer than the 63 characters a channel may have";
    const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '/';
    });
    return plain && !name.empty()
               ? ""
               : "'" + name + "' is not the name of a channel; valid: letters, digits, '_', '-' and '/'";
}

GraphFile read_graph_file(const fs::path& file) {
    return read_with_bases(file, {});
}

}  // namespace goalmouth
