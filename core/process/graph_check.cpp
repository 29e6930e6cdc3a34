#include "core/process/graph_check.h"

#include "core/messaging/channels.h"
#include "core/process/graph_value.h"
#include "core/process/text.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

namespace goalmouth {
namespace {

struct Publisher {
    const GraphProcess* process;
    const ChannelUse* use;
};

std::vector<std::string> parameter_keys(const ProgramDescription& description) {
    std::vector<std::string> keys;
    for (const auto& parameter : description.parameters) keys.push_back(parameter.key);
    return keys;
}

/// The program must know the parameter, and the value be one that it takes.
void check_setting(const GraphProcess& process, const GraphSetting& setting,
                   const std::vector<std::string>& keys) {
    const std::string where = setting.place.text() + ": " + process.name + ": ";
    const auto known = std::find(keys.begin(), keys.end(), setting.key);
    if (known == keys.end()) {
        throw ConfigurationError(where + "unknown parameter '" + setting.key + "' of " + process.executable +
                                 "; " + suggestion(setting.key, keys));
    }
    const auto& parameter = process.description.parameters[static_cast<std::size_t>(known - keys.begin())];
    if (!value_is_valid(setting.value, parameter.valid)) {
        throw ConfigurationError(where + setting.key + ": '" + setting.value + "' is not " + parameter.valid);
    }
}

std::optional<int> number(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// "239.255.76.67" → its first number; nothing where it is no IPv4 address.
std::optional<int> first_of_address(const std::string& address) {
    const auto parts = split(address, '.');
    if (parts.size() != 4 || address.ends_with('.')) return std::nullopt;
    for (const auto& part : parts) {
        const auto value = number(part);
        if (!value || *value < 0 || *value > 255) return std::nullopt;
    }
    return number(parts[0]);
}

std::string udpm_problem(const std::string& network) {
    if (network.empty()) return {};
    const auto query = network.find('?');
    const std::string host = network.substr(0, query);
    const auto colon = host.find(':');
    const auto first = first_of_address(host.substr(0, colon));
    if (!first || *first < 224 || *first > 239)
        return "the address is no multicast group (224.0.0.0…239.255.255.255)";
    if (colon != std::string::npos) {
        const auto port = number(host.substr(colon + 1));
        if (!port || *port < 1 || *port > 65535) return "the port is not a number in 1…65535";
    }
    if (query == std::string::npos) return {};
    for (const auto& option : split(network.substr(query + 1), '&')) {
        const auto equals = option.find('=');
        const std::string key = option.substr(0, equals);
        const auto value = equals == std::string::npos ? std::nullopt : number(option.substr(equals + 1));
        if (key != "ttl" && key != "recv_buf_size") {
            return "unknown option '" + key + "'; " + suggestion(key, {"ttl", "recv_buf_size"});
        }
        if (!value || *value < 0 || (key == "ttl" && *value > 255)) {
            return key + " is not a number" + (key == "ttl" ? " in 0…255" : " of bytes");
        }
    }
    return {};
}

}  // namespace

void check_lcm_url(const std::string& url, const std::string& where) {
    const auto fail = [&](const std::string& problem) {
        throw ConfigurationError(where + ": lcm_url: '" + url + "': " + problem +
                                 "; valid: udpm://GROUP:PORT?ttl=N, e.g. " + default_lcm_url +
                                 ", or tcpq://HOST:PORT with an LCM TCP server there");
    };
    const auto colon = url.find("://");
    if (colon == std::string::npos) fail("is not an LCM URL");
    const std::string provider = url.substr(0, colon);
    if (provider == "udpm") {
        const std::string problem = udpm_problem(url.substr(colon + 3));
        if (!problem.empty()) fail(problem);
    } else if (provider == "memq" || provider == "file") {
        fail("does not carry messages between processes");
    } else if (provider != "tcpq" && provider != "mpudpm") {
        fail("LCM has no provider '" + provider + "'");
    }
}

void check_parameters(const Graph& graph, const std::vector<GraphSetting>& common) {
    std::set<std::string> all;
    for (const auto& process : graph.processes) {
        if (!process.described) continue;
        const auto keys = parameter_keys(process.description);
        all.insert(keys.begin(), keys.end());
        for (const auto& setting : process.settings) check_setting(process, setting, keys);
    }
    for (const auto& setting : common) {
        if (all.contains(setting.key)) continue;
        throw ConfigurationError(setting.place.text() + ": common: no process has a parameter '" +
                                 setting.key + "'; " + suggestion(setting.key, {all.begin(), all.end()}));
    }
}

void check_channels(const Graph& graph, const std::vector<PlacedText>& external) {
    std::map<std::string, Publisher> publishers;
    std::set<std::string> outside;
    for (const auto& channel : external) outside.insert(channel.text);
    for (const auto& process : graph.processes) {
        for (const auto& use : process.description.info.publishes) {
            const std::string channel = process.channel(use.channel);
            if (use.channel == channels::status) continue;  // every process has its share of this one
            const auto [known, added] = publishers.insert({channel, {&process, &use}});
            const std::string advice =
                "; rename one under 'channels' of its process, or leave one process out";
            if (!added) {
                throw ConfigurationError(process.place.text() + ": " + process.name + ": publishes " +
                                         channel + ", which " + known->second.process->name + " (" +
                                         known->second.process->place.text() + ") publishes too" + advice);
            }
            if (outside.contains(channel)) {
                throw ConfigurationError(process.place.text() + ": " + process.name + ": publishes " +
                                         channel + ", which 'external' says comes from outside the graph" +
                                         advice);
            }
        }
    }
    std::vector<std::string> published;
    for (const auto& [channel, publisher] : publishers) published.push_back(channel);
    published.insert(published.end(), outside.begin(), outside.end());

    std::set<std::string> read;
    for (const auto& process : graph.processes) {
        for (const auto& use : process.description.info.subscribes) {
            const std::string channel = process.channel(use.channel);
            read.insert(channel);
            if (use.channel == channels::status || outside.contains(channel)) continue;
            const auto found = publishers.find(channel);
            if (found == publishers.end()) {
                if (use.optional) continue;
                throw ConfigurationError(
                    process.place.text() + ": " + process.name + ": subscribes " + channel +
                    (use.type.empty() ? "" : " (" + use.type + ")") +
                    ", which nobody publishes; add a process that does, or list it under 'external' if it "
                    "comes from outside the graph; " +
                    suggestion(channel, published));
            }
            const auto& type = found->second.use->type;
            if (!use.type.empty() && !type.empty() && use.type != type) {
                throw ConfigurationError(
                    process.place.text() + ": " + process.name + ": subscribes " + channel + " as " +
                    use.type + ", but " + found->second.process->name + " (" +
                    found->second.process->place.text() + ") publishes " + type + " on it");
            }
        }
    }
    for (const auto& channel : external) {
        if (read.contains(channel.text)) continue;
        throw ConfigurationError(channel.place.text() + ": external: no process subscribes " + channel.text +
                                 "; " + suggestion(channel.text, {read.begin(), read.end()}));
    }
}

}  // namespace goalmouth
