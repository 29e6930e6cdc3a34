#include "tools/evaluate/localisation.h"

#include "core/process/configuration.h"
#include "core/process/paths.h"
#include "core/process/text.h"
#include "modules/simulator/simulator_module.h"
#include "tools/evaluate/command_line.h"
#include "tools/evaluate/graph_settings.h"
#include "tools/evaluate/localisation_report.h"
#include "tools/evaluate/localisation_run.h"
#include "tools/evaluate/paper.h"
#include "tools/evaluate/progress.h"
#include "tools/evaluate/shard.h"
#include "tools/goalmouth/checks.h"
#include "tools/goalmouth/interrupt.h"
#include "tools/goalmouth/output.h"

#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>

#include <CLI/CLI.hpp>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

struct Given {
    int runs = 100;
    std::string detectors = "histogram,ransac,refined";
    std::uint64_t seed = 1;
    int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    double seconds = 0.0;  // 0: as long as the walk takes
    std::string scene;
    std::vector<std::string> settings;
    fs::path field;
    fs::path camera;
    fs::path colours;
    std::string shard;
    std::string json;
    fs::path report;
};

std::string command_of(const Given& given) {
    CommandLine line("goalmouth evaluate localisation");
    line.option("--runs", std::to_string(given.runs)).option("--detectors", given.detectors);
    line.option("--seed", std::to_string(given.seed));
    if (given.seconds > 0.0) line.option("--seconds", fmt::format("{}", given.seconds));
    line.option("--scene", given.scene);
    for (const std::string& setting : given.settings) line.option("--set", setting);
    line.option("--field", given.field.string()).option("--camera", given.camera.string());
    line.option("--colours", given.colours.string()).option("--shard", given.shard);
    return line.option("--json", given.json).option("--report", given.report.string()).text();
}

fs::path given_file(const fs::path& file, const std::string& option) {
    if (!fs::is_regular_file(file)) throw ConfigurationError(option + ": there is no file " + file.string());
    return file;
}

/// A file, or the name of one in config/scenes.
fs::path find_scene(const std::string& name_or_file) {
    const fs::path folder = config_folder() / "scenes";
    for (const fs::path& file : {fs::path(name_or_file), folder / (name_or_file + ".yaml")})
        if (fs::is_regular_file(file)) return file;
    std::vector<std::string> known;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".yaml") known.push_back(entry.path().stem().string());
    std::sort(known.begin(), known.end());
    throw ConfigurationError("--scene: no scene '" + name_or_file + "': neither a file nor one in " +
                             folder.string() + "; " + suggestion(name_or_file, known));
}

LocalisationOptions options_of(const Given& given) {
    LocalisationOptions options;
    options.runs = given.runs;
    options.seed = given.seed;
    options.jobs = given.jobs;
    options.seconds = given.seconds;
    const std::vector<std::string> graphs = graph_list(given.detectors, "--detectors");
    const auto shares = share_out_settings(given.settings, graphs);
    for (std::size_t i = 0; i < graphs.size(); ++i)
        options.detectors.push_back({graph_name(graphs[i]), graphs[i], shares[i]});
    if (!given.shard.empty()) {
        const Shard shard = parse_shard(given.shard, "--shard");
        options.part = shard.part;
        options.parts = shard.parts;
    }

    const auto simulator = load_parameters<SimulatorParameters>(config_folder() / "modules/simulator.yaml");
    const fs::path scene = given.scene.empty() ? fs::path(simulator.scene) : find_scene(given.scene);
    options.scene = scene.stem().string();
    options.frames_per_second = simulator.frames_per_second;
    options.simulation = {load_parameters_or_defaults<ImageFormationParameters>(scene), simulator.walk,
                          simulator.kinematics};
    // Scenes of the paper's other experiment lack the own goal. Here the filter knows a field with both, and
    // starts at either side line: which of them, it could not tell.
    options.simulation.formation.hall.own_goal = true;
    options.field_file = given.field.empty() ? fs::path(simulator.field) : given_file(given.field, "--field");
    options.field = load_parameters_or_defaults<Field>(options.field_file);
    options.camera = load_parameters_or_defaults<Intrinsics>(
        given.camera.empty() ? fs::path(simulator.camera) : given_file(given.camera, "--camera"));
    if (!given.colours.empty()) options.colours = given_file(given.colours, "--colours");
    return options;
}

void write_outputs(const LocalisationResult& result, const std::string& json, const fs::path& report) {
    if (!json.empty()) write_text(json, localisation_json(result).dump() + "\n", "--json");
    if (!report.empty()) write_localisation_report(result, report);
    std::cout << localisation_text(result);
}

int evaluate(const Given& given) {
    expect_outputs(given.json, given.report);
    const LocalisationOptions options = options_of(given);
    const Interrupt interrupt;
    LocalisationResult result;
    {
        std::optional<Progress> bar;
        result = evaluate_localisation(options,
                                       {.expect = [&](std::size_t frames) { bar.emplace(frames, "frames"); },
                                        .step = [&] { bar->step(); },
                                        .stop = [&] { return interrupt.requested(); }});
    }
    result.version = GOALMOUTH_VERSION;
    result.command = command_of(given);
    write_outputs(result, given.json, given.report);
    if (!interrupt.requested()) return 0;
    std::cerr << "goalmouth: interrupted: the " << result.done.size() << " runs that were done are written\n";
    return Interrupt::exit_code;
}

}  // namespace

int merge_localisation(const std::vector<fs::path>& files, const std::string& json, const fs::path& report,
                       bool partial) {
    expect_outputs(json, report);
    LocalisationResult result = join_localisation(files);
    if (!result.complete() && !partial) {
        throw ConfigurationError(
            fmt::format("merge: {} of {} runs are missing (--partial merges all the same)",
                        static_cast<std::size_t>(result.runs) - result.done.size(), result.runs));
    }
    write_outputs(result, json, report);
    return 0;
}

void add_evaluate_localisation(CLI::App& evaluate_verb, Action& action) {
    const auto given = std::make_shared<Given>();
    CLI::App* verb = evaluate_verb.add_subcommand(
        "localisation", "The paper's walk from the side line to the ball, goalposts the only landmarks");
    verb->add_option("--runs", given->runs, "walks, each with random numbers of its own")
        ->check(CLI::Range(1, 100000).description(""))
        ->capture_default_str();
    verb->add_option("--detectors", given->detectors,
                     "graphs to compare: names in config/graphs or files, with commas between")
        ->capture_default_str();
    verb->add_option("--seed", given->seed, "everything random follows from it")->capture_default_str();
    verb->add_option("--seconds", given->seconds, "length of the walk; else until the robot is at the ball")
        ->check(positive_number());
    verb->add_option(
        "--scene", given->scene,
        "hall, light and camera: a name in config/scenes or a file; else the simulator's; both goals stand "
        "whatever it says");
    verb->add_option("--set", given->settings, "PROCESS.KEY=VALUE: a parameter of every graph that has it")
        ->allow_extra_args(false);
    verb->add_option("--field", given->field, "field description; else the simulator's");
    verb->add_option("--camera", given->camera, "calibration; else the simulator's");
    verb->add_option("--colours", given->colours, "colour table; else the graphs'");
    verb->add_option("--jobs", given->jobs, "walks under way at once; never changes the result")
        ->check(CLI::Range(1, 1024).description(""))
        ->capture_default_str();
    verb->add_option("--shard", given->shard,
                     "I/N: only every N-th run, from the I-th; `goalmouth evaluate merge` joins the files");
    verb->add_option("--json", given->json, "write the figures and every run there");
    verb->add_option("--report", given->report, "folder for a page with tables, paths and errors");
    verb->footer(
        "At least one of --json and --report is needed. The robot walks as config/modules/simulator.yaml "
        "says.\nCtrl-C drops the runs under way and writes those that were done.\n"
        "Exit code: 0 all went well, 2 the command line or a file is wrong, 130 interrupted.");
    verb->callback([given, &action] { action = [given] { return evaluate(*given); }; });
}

}  // namespace goalmouth
