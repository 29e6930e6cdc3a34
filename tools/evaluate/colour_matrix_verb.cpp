#include "core/imaging/colour_table_file.h"
#include "core/process/configuration.h"
#include "tools/evaluate/colour_matrix.h"
#include "tools/evaluate/command_line.h"
#include "tools/evaluate/graph_settings.h"
#include "tools/evaluate/progress.h"
#include "tools/goalmouth/interrupt.h"
#include "tools/goalmouth/output.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace goalmouth {
namespace {

struct Given {
    ColourMatrixOptions options;
    std::string detectors = "ransac,tuned";
    std::string json;
};

std::string command_of(const Given& given) {
    CommandLine line("goalmouth evaluate colours");
    const ImagesOptions& o = given.options.images;
    line.word(o.folder.string()).option("--annotations", o.annotations.string());
    for (const std::string& set : o.sets) line.option("--set", set);
    for (const std::string& table : given.options.tables) line.option("--table", table);
    return line.option("--detectors", given.detectors)
        .option("--folds", std::to_string(o.folds))
        .option("--json", given.json)
        .text();
}

int evaluate(Given given) {
    given.options.images.detectors = graph_list(given.detectors, "--detectors");
    if (!given.json.empty()) expect_writable(given.json, "--json");
    const Interrupt interrupt;
    std::vector<ColourMatrixRow> rows;
    {
        std::optional<Progress> bar;
        rows = colour_matrix(given.options,
                             {.expect = [&](std::size_t pictures) { bar.emplace(pictures, "pictures"); },
                              .step = [&] { bar->step(); },
                              .stop = [&] { return interrupt.requested(); }});
    }
    if (interrupt.requested()) {
        std::cerr << "goalmouth: interrupted: nothing is written\n";
        return Interrupt::exit_code;
    }
    const std::vector<std::string>& detectors = given.options.images.detectors;
    if (!given.json.empty()) {
        const nlohmann::ordered_json json = {{"what", "colours"},
                                             {"version", GOALMOUTH_VERSION},
                                             {"command", command_of(given)},
                                             {"matrix", colour_matrix_json(rows, detectors)}};
        write_text(given.json, json.dump(1) + "\n", "--json");
    }
    std::cout << colour_matrix_text(rows, detectors);
    return 0;
}

}  // namespace

void add_evaluate_colours(CLI::App& evaluate_verb, Action& action) {
    const auto given = std::make_shared<Given>();
    ImagesOptions& options = given->options.images;
    options.jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    CLI::App* verb = evaluate_verb.add_subcommand(
        "colours",
        "Colour tables against each other, across venues: learnt with and without labels, and imported");
    verb->add_option("DIR", options.folder, "folder of the pictures and of annotations.json")->required();
    verb->add_option("--annotations", options.annotations,
                     "annotation file (docs/colour_tables.md), its pictures' names counting from DIR");
    verb->add_option("--set", options.sets, "a set of the annotations; may be repeated; else all of them")
        ->allow_extra_args(false);
    verb->add_option("--table", given->options.tables,
                     "a table to compare with, may be repeated: FILE.gmct, nubots_2013:FILE.lut or "
                     "gmu_2014:FILE.raw")
        ->allow_extra_args(false);
    verb->add_option("--detectors", given->detectors,
                     "graphs to compare: names in config/graphs or files, with commas between")
        ->capture_default_str();
    verb->add_option("--folds", options.folds,
                     "parts a set is split into: on its own pictures a table is judged that did not see them")
        ->check(CLI::Range(2, 1000).description(""))
        ->capture_default_str();
    verb->add_option("--json", given->json, "write the figures there");
    verb->add_option("--jobs", options.jobs, "pictures worked on at once; never changes the result")
        ->check(CLI::Range(1, 1024).description(""))
        ->capture_default_str();
    verb->footer(
        "Exit code: 0 all went well, 2 the command line, the annotations, a picture or a table is wrong, 130 "
        "interrupted.");
    verb->callback([given, &action] { action = [given] { return evaluate(*given); }; });
}

}  // namespace goalmouth
