#include "tools/evaluate/paper.h"

#include "core/process/configuration.h"
#include "tools/evaluate/command_line.h"
#include "tools/evaluate/evaluate.h"
#include "tools/evaluate/paper_report.h"
#include "tools/evaluate/paper_table.h"
#include "tools/evaluate/progress.h"
#include "tools/evaluate/report/figure.h"
#include "tools/evaluate/report/report_folder.h"
#include "tools/evaluate/shard.h"
#include "tools/goalmouth/interrupt.h"
#include "tools/goalmouth/output.h"

#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <thread>

#include <CLI/CLI.hpp>

namespace goalmouth {
namespace {

/// CLI11 takes −1 for the largest number there is.
CLI::Validator seed_number() {
    return {[](std::string& text) {
                const bool digits =
                    !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
                return digits ? std::string() : "'" + text + "' is no whole number from 0";
            },
            ""};
}

int processors() {
    return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace

void expect_outputs(const std::string& json, const std::string& report) {
    if (json.empty() && report.empty())
        throw ConfigurationError("nothing to write: give --json FILE, --report DIR or both");
    if (!json.empty()) expect_writable(json, "--json");
    if (!report.empty()) {
        expect_report_folder(report);
        expect_gnuplot();
    }
}

std::string paper_command(const PaperOptions& options, const PaperTask& task) {
    CommandLine command("goalmouth evaluate paper");
    command.option("--frames-per-cell", std::to_string(options.frames_per_cell))
        .option("--size", options.size)
        .option("--detectors", options.detectors)
        .option("--scene", options.scenes)
        .option("--seed", std::to_string(options.seed));
    for (const auto& setting : options.settings) command.option("--set", setting);
    command.option("--field", options.field)
        .option("--camera", options.camera)
        .option("--colours", options.colours);
    if (task.shard) command.option("--shard", shard_text(*task.shard));
    command.option("--json", task.json).option("--report", task.report);
    return command.text();
}

int evaluate_paper(const PaperOptions& options, const PaperSetup& setup, const PaperTask& task) {
    expect_outputs(task.json, task.report);
    const Shard shard = task.shard.value_or(Shard{});
    const std::size_t wanted = frame_count(setup.grid, shard);

    PaperResult result;
    result.version = GOALMOUTH_VERSION;
    result.command = paper_command(options, task);
    result.options = options;
    for (const auto& scene : setup.grid.scenes) result.scenes.push_back(scene.name);
    for (const auto& detector : setup.detectors) result.detectors.push_back(detector.name);
    result.settings = setup.settings;
    result.shard = task.shard;

    const Interrupt interrupt;
    {
        Progress progress(wanted, "frames");
        PaperWork work;
        work.shard = shard;
        work.jobs = task.jobs;
        work.stop = [&] { return interrupt.requested(); };
        work.step = [&] { progress.step(); };
        result.records = run_paper(setup.grid, setup.detectors, work);
    }
    result.complete = result.records.size() == wanted;

    if (!task.json.empty()) write_text(task.json, paper_json(result), "--json");
    if (!task.report.empty()) write_paper_report(result, &setup, task.report);
    std::cout << paper_table(result);
    if (result.complete) return 0;
    std::cerr << "goalmouth: interrupted: " << result.records.size() << " of " << wanted
              << " frames were done and are written; \"complete\" is false\n";
    return Interrupt::exit_code;
}

void add_evaluate_paper(CLI::App& evaluate, Action& action) {
    struct Given {
        PaperOptions options;
        PaperTask task;
        std::string shard;
    };
    const auto given = std::make_shared<Given>();
    given->task.jobs = processors();
    PaperOptions& options = given->options;
    CLI::App* verb = evaluate.add_subcommand(
        "paper", "The paper's experiment: 6 distances by 3 tilts, on frames rendered with known truth");
    verb->add_option("--frames-per-cell", options.frames_per_cell,
                     "frames at each distance and tilt of each scene; the paper has 3600 in all")
        ->check(CLI::Range(1, most_frames_per_cell).description(""))
        ->capture_default_str();
    verb->add_option("--size", options.size, "WIDTHxHEIGHT of the frames [px], of the calibration's shape")
        ->capture_default_str();
    verb->add_option(
            "--detectors", options.detectors,
            "graphs to compare: names in config/graphs (histogram, ransac, refined, tuned) or files, with "
            "commas between")
        ->capture_default_str();
    verb->add_option("--scene", options.scenes,
                     "flat, lit, clutter, match (config/evaluation) or files, with commas between")
        ->capture_default_str();
    verb->add_option("--seed", options.seed, "everything random follows from it")
        ->check(seed_number())
        ->capture_default_str();
    verb->add_option("--jobs", given->task.jobs, "frames worked on at once; never changes the result")
        ->check(CLI::Range(1, 1024).description(""))
        ->capture_default_str();
    verb->add_option("--shard", given->shard,
                     "I/N: only every N-th frame, from the I-th; `goalmouth evaluate merge` joins the files");
    verb->add_option("--set", options.settings,
                     "PROCESS.KEY=VALUE: a parameter of every graph that has it; may be repeated")
        ->allow_extra_args(false);
    verb->add_option("--field", options.field, "field description; else config/fields/kidsize_2013.yaml");
    verb->add_option("--camera", options.camera,
                     "calibration, scaled to the size; else config/cameras/c905.yaml");
    verb->add_option("--colours", options.colours, "colour table for every graph; else each graph's own");
    verb->add_option("--json", given->task.json, "write the figures and every frame's record there");
    verb->add_option("--report", given->task.report,
                     "folder for index.html with tables, figures (SVG and PNG too) and the worst failures");
    verb->footer(fmt::format(
        "A true post is detected where both edges of a detection lie within {:g} % of the post's width of "
        "the "
        "true edges,\nat a quarter and at three quarters of its visible length, and the detection covers at "
        "least {:g} % of that length.\nAll other detections are false posts, but for those of posts that are "
        "hidden or cut off too far to count.\nDistances are judged by the post in line [cm, estimate minus "
        "truth], over every detection that means it; of a chain that\nrefines, over those it calls good. The "
        "bound is the least standard deviation that the post's two edges allow.\n\n"
        "At least one of --json and --report is needed; a table goes to standard output, progress to "
        "standard "
        "error.\nThe same command gives the same files, bit for bit. Ctrl-C ends after the frames in hand "
        "and "
        "writes what was done.\n\n"
        "Example, the paper's 3600 frames:\n"
        "  goalmouth evaluate paper --frames-per-cell 200 --json paper.json --report paper\n\n"
        "Exit code: 0 all went well, 2 the command line or a file is wrong, 130 interrupted.",
        100.0 * MatchingRule{}.fraction, 100.0 * MatchingRule{}.coverage));
    verb->callback([given, &action] {
        action = [given] {
            if (!given->shard.empty()) given->task.shard = parse_shard(given->shard, "--shard");
            expect_outputs(given->task.json, given->task.report);
            return evaluate_paper(given->options, set_up_paper(given->options), given->task);
        };
    });
}

}  // namespace goalmouth
