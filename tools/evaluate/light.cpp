#include "tools/evaluate/light.h"

#include "core/process/configuration.h"
#include "tools/evaluate/command_line.h"
#include "tools/evaluate/paper.h"
#include "tools/evaluate/progress.h"
#include "tools/goalmouth/interrupt.h"
#include "tools/goalmouth/output.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>
#include <thread>

#include <CLI/CLI.hpp>

namespace goalmouth {
namespace {

struct Given {
    LightOptions options;
    int jobs = 1;
    std::string json;
    std::string report;
};

std::string command_of(const Given& given) {
    const LightOptions& o = given.options;
    CommandLine command("goalmouth evaluate light");
    command.option("--detectors", o.paper.detectors)
        .option("--scene", o.paper.scenes)
        .option("--brightness", fmt::format("{:g}", fmt::join(o.brightness, ",")))
        .option("--temperature", fmt::format("{:g}", fmt::join(o.temperatures, ",")))
        .option("--frames-per-cell", std::to_string(o.paper.frames_per_cell))
        .option("--size", o.paper.size)
        .option("--seed", std::to_string(o.paper.seed));
    for (const std::string& setting : o.paper.settings) command.option("--set", setting);
    return command.option("--field", o.paper.field)
        .option("--camera", o.paper.camera)
        .option("--colours", o.paper.colours)
        .option("--json", given.json)
        .option("--report", given.report)
        .text();
}

int evaluate(const Given& given) {
    expect_outputs(given.json, given.report);
    const LightSetup setup = set_up_light(given.options);
    LightResult result;
    result.version = GOALMOUTH_VERSION;
    result.command = command_of(given);
    result.options = given.options;
    result.scene = setup.grid.paper.scenes.front().name;
    for (const LightDetector& detector : setup.detectors) result.detectors.push_back(detector.name);
    result.settings = setup.settings;
    result.lights = setup.grid.lights;
    const Interrupt interrupt;
    {
        Progress progress(sequence_frames(setup.grid) * setup.grid.lights.size(), "frames");
        result.sequences =
            run_light(setup.grid, setup.detectors,
                      {given.jobs, [&] { return interrupt.requested(); }, [&] { progress.step(); }});
    }
    if (!given.json.empty()) write_text(given.json, light_json(result), "--json");
    if (!given.report.empty()) write_light_report(result, given.report);
    std::cout << light_table(result);
    if (result.complete()) return 0;
    std::cerr << "goalmouth: interrupted: only lights that were done are written; \"complete\" is false\n";
    return Interrupt::exit_code;
}

}  // namespace

void add_evaluate_light(CLI::App& evaluate_verb, Action& action) {
    const auto given = std::make_shared<Given>();
    given->jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    PaperOptions& paper = given->options.paper;
    CLI::App* verb = evaluate_verb.add_subcommand(
        "light", "Posts found in other light, with a colour table that follows it and without");
    verb->add_option("--detectors", paper.detectors,
                     "graphs to compare: names in config/graphs or files, with commas between; each gets "
                     "colours_adapt where it has none")
        ->capture_default_str();
    verb->add_option("--scene", paper.scenes, "flat, lit, clutter, match (config/evaluation) or a file")
        ->capture_default_str();
    verb->add_option("--brightness", given->options.brightness,
                     "factors on the scene's light, with commas between")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::Range(0.01, 100.0).description(""));
    verb->add_option("--temperature", given->options.temperatures,
                     "colour temperatures of the light [K], with commas between")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::Range(1700.0, 25000.0).description(""));
    verb->add_option("--frames-per-cell", paper.frames_per_cell,
                     "judged frames of each light at each of the 18 distances and tilts")
        ->check(CLI::Range(1, 1000).description(""))
        ->capture_default_str();
    verb->add_option("--size", paper.size, "WIDTHxHEIGHT of the frames [px], of the calibration's shape")
        ->capture_default_str();
    verb->add_option("--seed", paper.seed, "everything random follows from it")->capture_default_str();
    verb->add_option("--jobs", given->jobs, "lights worked on at once; never changes the result")
        ->check(CLI::Range(1, 1024).description(""))
        ->capture_default_str();
    verb->add_option("--set", paper.settings,
                     "PROCESS.KEY=VALUE: a parameter of every graph that has it; may be repeated")
        ->allow_extra_args(false);
    verb->add_option("--field", paper.field, "field description; else config/fields/kidsize_2013.yaml");
    verb->add_option("--camera", paper.camera,
                     "calibration, scaled to the size; else config/cameras/c905.yaml");
    verb->add_option("--colours", paper.colours, "colour table for every graph; else each graph's own");
    verb->add_option("--json", given->json, "write the figures there, by light and cell");
    verb->add_option("--report", given->report,
                     "folder for index.html with figures by brightness and by temperature (SVG and PNG too)");
    verb->footer(
        "Each light has a sequence of frames that begins in the scene's own light, goes slowly over to the "
        "other and stays\nthere; posts are judged in the last part, by the rule of `goalmouth evaluate "
        "paper`. Brightness goes one by one at the\nscene's temperature, temperature at its brightness, and "
        "the extremes of both together. Light is changed before noise\nand clipping; colours are those of "
        "black bodies (core/simulation/exposure.h names the source), green kept.\n\n"
        "At least one of --json and --report is needed; a table goes to standard output, progress to "
        "standard error.\nThe same command gives the same files, bit for bit.\n\n"
        "Exit code: 0 all went well, 2 the command line or a file is wrong, 130 interrupted.");
    verb->callback([given, &action] { action = [given] { return evaluate(*given); }; });
}

}  // namespace goalmouth
