#include "core/process/run_module.h"

#include "core/messaging/channels.h"
#include "core/messaging/lcm_bus.h"
#include "core/process/paths.h"
#include "core/process/text.h"

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <iostream>
#include <string>
#include <sys/prctl.h>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>
#include <goalmouth/status_t.hpp>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <yaml-cpp/yaml.h>

namespace goalmouth {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr auto status_interval = std::chrono::seconds(1);
constexpr unsigned long finest_timer_ns = 1;  // the kernel lets a sleep last 50 µs longer where nobody asks

volatile std::sig_atomic_t stop_asked = 0;

void ask_to_stop(int) {
    stop_asked = 1;
}

void stop_on_signals() {
    struct sigaction action {};
    action.sa_handler = ask_to_stop;  // without SA_RESTART: a wait for messages ends at once
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    std::signal(SIGPIPE, SIG_IGN);  // whoever read our log lines may be gone; that is no reason to die
}

void describe_channels(YAML::Emitter& out, const char* key, const std::vector<ChannelUse>& uses) {
    out << YAML::Key << key << YAML::Value << YAML::BeginSeq;
    for (const auto& use : uses) {
        out << YAML::BeginMap << YAML::Key << "channel" << YAML::Value << use.channel << YAML::Key << "type"
            << YAML::Value << use.type << YAML::Key << "meaning" << YAML::Value << use.meaning << YAML::Key
            << "optional" << YAML::Value << use.optional << YAML::EndMap;
    }
    out << YAML::EndSeq;
}

/// What `--describe` prints; the launcher checks graphs against it.
std::string description(const ModuleType& type) {
    YAML::Emitter out;
    out << YAML::BeginMap << YAML::Key << "executable" << YAML::Value << type.info.executable << YAML::Key
        << "summary" << YAML::Value << type.info.summary;
    describe_channels(out, "subscribes", type.info.subscribes);
    describe_channels(out, "publishes", type.info.publishes);
    out << YAML::Key << "parameters" << YAML::Value << YAML::BeginSeq;
    for (const auto& p : type.parameters) {
        out << YAML::BeginMap << YAML::Key << "key" << YAML::Value << p.key << YAML::Key << "value"
            << YAML::Value << YAML::DoubleQuoted << p.value << YAML::Key << "valid" << YAML::Value << p.valid
            << YAML::Key << "unit" << YAML::Value << p.unit << YAML::Key << "meaning" << YAML::Value
            << p.meaning << YAML::EndMap;
    }
    out << YAML::EndSeq << YAML::EndMap;
    return out.c_str();
}

std::pair<std::string, std::string> key_and_value(const std::string& text, const char* option) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        throw ConfigurationError(std::string(option) + ": '" + text + "' is not of the form KEY=VALUE");
    }
    return {text.substr(0, equals), text.substr(equals + 1)};
}

struct CommandLine {
    std::string lcm_url;
    std::string config;
    std::string name;
    std::vector<std::string> settings;
    std::vector<std::string> channels;
    std::uint64_t seed = 1;
    bool describe = false;
    bool print_config = false;
};

Configuration configuration_of(const ModuleType& type, const CommandLine& line) {
    Configuration configuration;
    if (!line.config.empty()) {
        configuration = Configuration::from_file(line.config);
    } else {
        const auto usual = config_folder() / "modules" / (type.info.executable + ".yaml");
        if (std::filesystem::exists(usual)) configuration = Configuration::from_file(usual);
    }
    for (const auto& setting : line.settings) {
        const auto [key, value] = key_and_value(setting, "--set");
        configuration.set(key, value, "--set");
    }
    return configuration;
}

std::map<std::string, std::string> channels_of(const ModuleType& type, const CommandLine& line) {
    std::vector<std::string> known = {channels::status};
    for (const auto& use : type.info.subscribes) known.push_back(use.channel);
    for (const auto& use : type.info.publishes) known.push_back(use.channel);
    std::map<std::string, std::string> renamed;
    for (const auto& text : line.channels) {
        const auto [from, to] = key_and_value(text, "--channel");
        if (std::find(known.begin(), known.end(), from) == known.end()) {
            throw ConfigurationError("--channel: " + type.info.executable + " does not use a channel '" +
                                     from + "'; " + suggestion(from, known));
        }
        if (to.empty()) throw ConfigurationError("--channel: " + from + " needs a new name");
        renamed[from] = to;
    }
    return renamed;
}

/// Waits for messages until `wake` at the latest. The bus waits in whole milliseconds; where `exact`, what is
/// left of the last one is slept, so that a source is not late by it.
void wait_for_messages(Bus& bus, Clock::time_point wake, bool exact) {
    const auto left = std::max(Clock::duration::zero(), wake - Clock::now());
    if (stop_asked) return;
    if (!exact) {
        bus.dispatch(std::chrono::ceil<milliseconds>(left));
    } else if (!bus.dispatch(std::chrono::floor<milliseconds>(left)) && !stop_asked) {
        const auto rest = wake - Clock::now();
        if (rest < milliseconds(1)) std::this_thread::sleep_for(rest);
    }
}

void run(const ModuleType& type, const CommandLine& line) {
    const Configuration configuration = configuration_of(type, line);
    const auto renamed = channels_of(type, line);

    ::prctl(PR_SET_TIMERSLACK, finest_timer_ns);  // LCM's threads take it over
    LcmBus bus(line.lcm_url);
    Status status;
    ModuleContext context{
        bus, status, line.name, line.seed, renamed, line.lcm_url, [](const std::string& url) {
            return std::make_shared<LcmBus>(url);
        }};
    const auto module = type.create(context, configuration);
    const std::string status_channel = context.channel(channels::status);
    const auto report = [&](std::int8_t state) {
        status.report(bus, status_channel, line.name, type.info.executable, state);
    };

    report(status_t::STARTING);
    auto next_report = Clock::now() + status_interval;
    while (!stop_asked && !module->finished()) {
        const auto due = Clock::now() + module->tick();
        const auto wake = std::min({due, next_report, Clock::now() + Clock::duration(milliseconds(100))});
        wait_for_messages(bus, wake, wake == due);
        if (Clock::now() >= next_report) {
            report(status_t::RUNNING);
            next_report = std::max(next_report + status_interval, Clock::now());
        }
    }
    report(status_t::STOPPED);
}

}  // namespace

int run_module_program(const ModuleType& type, int argc, char** argv) {
    CommandLine line;
    line.name = type.info.executable;
    CLI::App app{type.info.summary, type.info.executable};
    app.add_option("--lcm-url", line.lcm_url, "where the graph talks, e.g. udpm://239.255.76.67:7667?ttl=0")
        ->envname("LCM_DEFAULT_URL")
        ->capture_default_str();
    app.add_option("--config", line.config,
                   "parameters, YAML [config/modules/" + type.info.executable + ".yaml]")
        ->type_name("FILE");
    app.add_option("--set", line.settings, "one parameter, over the file's (repeatable)")
        ->type_name("KEY=VALUE")
        ->take_all();
    app.add_option("--name", line.name, "name in the graph")->capture_default_str();
    app.add_option("--channel", line.channels, "another name for a channel (repeatable)")
        ->type_name("DEFAULT=NAME")
        ->take_all();
    app.add_option("--seed", line.seed, "seed of the graph: same seed and input, same output")
        ->capture_default_str();
    app.add_flag("--describe", line.describe, "print channels and parameters as YAML, and end");
    app.add_flag("--print-config", line.print_config,
                 "print the parameters' defaults as a commented YAML file, and end");
    app.set_version_flag("--version", type.info.executable + " (goalmouth " GOALMOUTH_VERSION ")");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (line.describe) {
        std::cout << description(type) << '\n';
        return 0;
    }
    if (line.print_config) {
        std::cout << parameters_as_yaml(type.parameters);
        return 0;
    }

    spdlog::set_default_logger(spdlog::stderr_color_st(line.name));
    spdlog::set_pattern("%^%l%$: %v");
    stop_on_signals();
    try {
        run(type, line);
        return 0;
    } catch (const ConfigurationError& error) {
        spdlog::error(error.what());
        return 2;
    } catch (const std::exception& error) {
        spdlog::error(error.what());
        return 1;
    }
}

}  // namespace goalmouth
