#include "tools/evaluate/images.h"

#include "core/process/configuration.h"
#include "tools/evaluate/command_line.h"
#include "tools/evaluate/graph_settings.h"
#include "tools/evaluate/images_report.h"
#include "tools/evaluate/progress.h"
#include "tools/evaluate/report/figure.h"
#include "tools/evaluate/report/report_folder.h"
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

constexpr const char* learn_word = "learn";

struct Given {
    ImagesOptions options;
    std::string detectors = "ransac,refined,tuned,histogram";
    std::vector<std::string> cameras;
    std::vector<std::string> fields;
    std::vector<std::string> poses;
    std::string colours;
    std::string json;
    std::filesystem::path report;
};

std::string command_of(const Given& given) {
    CommandLine line("goalmouth evaluate images");
    const ImagesOptions& o = given.options;
    line.word(o.folder.string()).option("--annotations", o.annotations.string());
    for (const std::string& set : o.sets) line.option("--set", set);
    line.option("--detectors", given.detectors).option("--colours", given.colours);
    if (o.colours.empty()) line.option("--folds", std::to_string(o.folds));
    for (const std::string& camera : given.cameras) line.option("--camera", camera);
    for (const std::string& field : given.fields) line.option("--field", field);
    for (const std::string& poses : given.poses) line.option("--poses", poses);
    return line.option("--json", given.json).option("--report", given.report.string()).text();
}

/// "SET=VALUE"; the set is "" where there is no "=".
template <class Value>
std::map<std::string, Value> by_set(const std::vector<std::string>& entries, const std::string& option) {
    std::map<std::string, Value> all;
    for (const std::string& entry : entries) {
        const auto equals = entry.find('=');
        const std::string set = equals == std::string::npos ? "" : entry.substr(0, equals);
        const std::string value = equals == std::string::npos ? entry : entry.substr(equals + 1);
        if (!all.emplace(set, value).second)
            throw ConfigurationError(option + ": given twice for " +
                                     (set.empty() ? "all sets" : "set \"" + set + "\""));
    }
    return all;
}

void take_lists(Given& given) {
    given.options.detectors = graph_list(given.detectors, "--detectors");
    given.options.cameras = by_set<std::filesystem::path>(given.cameras, "--camera");
    given.options.fields = by_set<std::filesystem::path>(given.fields, "--field");
    given.options.poses = by_set<std::string>(given.poses, "--poses");
    for (const auto& [set, pattern] : given.options.poses) {
        if (set.empty()) {
            throw ConfigurationError("--poses: \"" + pattern +
                                     "\" names no set; SET=PATTERN is needed, such as "
                                     "lab={}_{x_cm}_{y_cm}_{heading_deg}");
        }
        try {
            const PlacePattern valid(pattern);
        } catch (const ConfigurationError& error) {
            throw ConfigurationError(std::string("--poses: ") + error.what());
        }
    }
    given.options.without_labels = given.colours == learn_word;
    if (!given.options.without_labels) given.options.colours = given.colours;
    if (!given.options.colours.empty() && !std::filesystem::exists(given.options.colours))
        throw ConfigurationError("--colours: there is no file " + given.options.colours.string());
}

int evaluate(Given given) {
    take_lists(given);
    if (!given.json.empty()) expect_writable(given.json, "--json");
    if (!given.report.empty()) {
        expect_report_folder(given.report);
        expect_gnuplot();
    }
    ImagesResult result{GOALMOUTH_VERSION, command_of(given), given.options, {}};
    const Interrupt interrupt;
    {
        std::optional<Progress> bar;
        result.sets = evaluate_images(
            given.options, {.expect = [&](std::size_t pictures) { bar.emplace(pictures, "pictures"); },
                            .step = [&] { bar->step(); },
                            .stop = [&] { return interrupt.requested(); }});
    }
    if (!given.json.empty()) write_text(given.json, images_json(result).dump(1) + "\n", "--json");
    if (!given.report.empty()) write_images_report(result, given.report);
    std::cout << images_text(result);
    if (result.complete()) return 0;
    std::cerr << "goalmouth: interrupted: what was done by then is written; \"complete\" is false\n";
    return Interrupt::exit_code;
}

}  // namespace

void add_evaluate_images(CLI::App& evaluate_verb, Action& action) {
    const auto given = std::make_shared<Given>();
    ImagesOptions& options = given->options;
    options.jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    CLI::App* verb =
        evaluate_verb.add_subcommand("images", "Detectors against real pictures with posts marked by hand");
    verb->add_option("DIR", options.folder, "folder of the pictures and of annotations.json")->required();
    verb->add_option("--annotations", options.annotations,
                     "annotation file (docs/colour_tables.md), its pictures' names counting from DIR");
    verb->add_option("--set", options.sets, "a set of the annotations; may be repeated; else all of them")
        ->allow_extra_args(false);
    verb->add_option("--detectors", given->detectors,
                     "graphs to compare: names in config/graphs or files, with commas between")
        ->capture_default_str();
    verb->add_option("--colours", given->colours,
                     "colour table, or `learn`: tables are learnt from pictures as `goalmouth colours learn` "
                     "does, without a "
                     "look at their annotations; else they are learnt from the annotations. Each without the "
                     "pictures it is "
                     "for");
    CLI::Option* folds = verb->add_option("--folds", options.folds, "parts a set is split into for that")
                             ->check(CLI::Range(2, 1000).description(""))
                             ->capture_default_str();
    verb->add_option("--camera", given->cameras,
                     "FILE or SET=FILE, may be repeated: calibration; else config/cameras/SET.yaml where "
                     "there is one, else the graph's")
        ->allow_extra_args(false);
    verb->add_option(
            "--field", given->fields,
            "FILE or SET=FILE, may be repeated: field with the posts' diameter and the goals' places; "
            "else config/fields/SET.yaml where there is one, else the graph's")
        ->allow_extra_args(false);
    verb->add_option(
            "--poses", given->poses,
            "SET=PATTERN, may be repeated: file names tell where the robot stood, such as "
            "{}_{x_cm}_{y_cm}_{heading_deg}_{head_pitch_rad}_{head_yaw_rad}_{} (docs/evaluation.md); "
            "distances are compared then")
        ->allow_extra_args(false);
    verb->add_option("--json", given->json, "write figures and every picture's posts there");
    verb->add_option("--report", given->report, "folder for a page with tables, figures and failures");
    verb->add_option("--jobs", options.jobs, "pictures worked on at once; never changes the result")
        ->check(CLI::Range(1, 1024).description(""))
        ->capture_default_str();
    verb->footer(
        "Exit code: 0 all went well, 2 the command line, the annotations or a picture is wrong, 130 "
        "interrupted.");
    verb->callback([given, folds, &action] {
        if (folds->count() > 0 && !given->colours.empty() && given->colours != learn_word)
            throw CLI::ExcludesError("--folds", "--colours TABLE");
        action = [given] { return evaluate(*given); };
    });
}

}  // namespace goalmouth
