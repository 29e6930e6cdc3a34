#include "core/messaging/tap_url.h"
#include "core/process/graph.h"
#include "core/process/paths.h"
#include "tools/goalmouth/verbs.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <unistd.h>

#include <CLI/CLI.hpp>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

/// The first of `folders` that holds the jar.
fs::path find_jar(const std::string& jar, const std::vector<fs::path>& folders, const std::string& package) {
    std::string looked;
    for (const auto& folder : folders) {
        const fs::path file = (folder / jar).lexically_normal();
        if (fs::exists(file)) return file;
        looked += (looked.empty() ? "" : ", ") + file.string();
    }
    throw std::runtime_error("spy: no " + jar + " (looked at " + looked + "): " + package);
}

/// lcm-spy as Debian packages it does not start (it passes an option that Java 17 refuses), so its class is
/// run directly.
int spy(const std::string& lcm_url, const std::vector<std::string>& further) {
    const std::vector<fs::path> places = {"/usr/share/java", "/usr/local/share/java"};
    std::string classpath = find_jar("lcm.jar", places, "apt install liblcm-java").string();
    classpath += ":" + find_jar("jchart2d.jar", places, "apt install libjchart2d-java").string();
    classpath +=
        ":" +
        find_jar(
            "goalmouth-types.jar", {program_folder() / "../share/java"},
            "build the target goalmouth_java; it needs a JDK (apt install default-jdk-headless liblcm-java)")
            .string();
    if (const char* own = std::getenv("CLASSPATH")) classpath += std::string(":") + own;
    if (!std::getenv("DISPLAY"))
        throw std::runtime_error("spy: it shows a window, and there is no screen: $DISPLAY is not set");

    ::setenv("LCM_DEFAULT_URL", lcm_url.c_str(), 1);
    std::vector<std::string> command = {"java", "-Djava.net.preferIPv4Stack=true", "-cp", classpath,
                                        "lcm.spy.Spy"};
    command.insert(command.end(), further.begin(), further.end());
    std::vector<char*> argv;
    for (auto& word : command) argv.push_back(word.data());
    argv.push_back(nullptr);
    ::execvp(argv[0], argv.data());
    throw std::runtime_error(std::string("spy: cannot run java: ") + std::strerror(errno) +
                             ": apt install default-jre");
}

}  // namespace

void add_spy_verb(CLI::App& app, Action& action) {
    auto url = std::make_shared<std::string>();
    auto tap = std::make_shared<bool>(false);
    auto further = std::make_shared<std::vector<std::string>>();
    CLI::App* verb =
        app.add_subcommand("spy", "watch every channel in lcm-spy, with goalmouth's message types");
    verb->add_option("--lcm-url", *url,
                     "where the graph talks [$LCM_DEFAULT_URL, or " + std::string(default_lcm_url) + "]")
        ->type_name("URL");
    verb->add_flag("--tap", *tap,
                   "watch the port of the graph's tap instead, 1000 above the graph's: whole pictures, and "
                   "the graph's messages beside them");
    verb->add_option("arguments", *further, "further arguments for lcm-spy");
    verb->footer(
        "A tap that has a `url` of its own in the graph file is watched by --lcm-url with that URL.");
    verb->callback([url, tap, further, &action] {
        action = [url, tap, further] {
            const std::string graph = lcm_url_of(Graph{}, *url);
            return spy(*tap ? tap_url(graph) : graph, *further);
        };
    });
}

}  // namespace goalmouth
