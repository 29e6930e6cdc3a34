#include "tools/colours/colours.h"

#include "tools/colours/learn.h"
#include "tools/colours/teach.h"
#include "tools/colours/teach_editor.h"
#include "tools/goalmouth/file_action.h"

#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace goalmouth {

namespace {

std::optional<ImageSize> size_given(const std::string& text) {
    if (text.empty()) return std::nullopt;
    const auto size = parse_image_size(text);
    if (!size) throw ConfigurationError("--size: \"" + text + "\" is no size such as 640x480");
    return size;
}

std::string teach_footer() {
    std::string text = "In the window:\n";
    for (const EditorKey& key : editor_keys()) text += fmt::format("  {:<15} {}\n", key.key, key.meaning);
    return text +
           "\nA line of the text file, corners inclusive, 0 0 a picture's first pixel:\n"
           "  PICTURE CLASS X0 Y0 X1 Y1\n"
           "  PICTURE CLASS polygon X Y X Y X Y ...\n"
           "  PICTURE CLASS fill X Y TOLERANCE\n"
           "Pictures lie relative to the file, LOG@N is number N of a log's, # begins a remark. Classes: "
           "unclassified,\nfield, line, ball, goal, robot. Marks of \"unclassified\" say what none of them "
           "is.\n"
           "Exit code: 0 all went well, 2 the command line or a file is wrong or no window can be opened, "
           "130 "
           "interrupted.";
}

void add_teach(CLI::App& colours_verb, Action& action) {
    struct Given {
        TeachColoursOptions options;
        std::string size;
    };
    const auto given = std::make_shared<Given>();
    TeachColoursOptions& o = given->options;
    CLI::App* command = colours_verb.add_subcommand(
        "teach", "Make a table from what a person marks in pictures, in a window or in a text file");
    command
        ->add_option("IMAGE", o.inputs,
                     "pictures (PNG, JPEG, PPM, raw 4:2:2 as .yuyv), folders of them, or LCM logs that hold "
                     "pictures, to mark in a window; or one text file with marks, a line each")
        ->required()
        ->type_name("FILE");
    command->add_option("-o,--output", o.output, "Colour table to write (.gmct)")
        ->required()
        ->type_name("FILE");
    command
        ->add_option("--marks", o.marks,
                     "the window's marks: read where the file is there, and saved; else the output's name "
                     "with .marks")
        ->type_name("FILE");
    command->add_option("--most", o.most, "of more pictures than that, so many evenly spread are shown")
        ->check(CLI::Range(1, 10000).description(""))
        ->capture_default_str();
    command->add_option("--bits", o.bits, "Bits an axis")->check(CLI::Range(5, 8))->capture_default_str();
    command->add_option("--name", o.name, "Name of the table; default: the output's");
    command->add_option("--size", given->size, "WIDTHxHEIGHT of raw pictures [px]");
    command->footer(teach_footer());
    sets_action(command, action, [given] {
        given->options.size = size_given(given->size);
        return teach_colours(given->options);
    });
}

}  // namespace

void add_colours_learn(CLI::App& colours_verb, Action& action) {
    add_teach(colours_verb, action);
    struct Given {
        LearnColoursOptions options;
        std::string size;
    };
    const auto given = std::make_shared<Given>();
    LearnColoursOptions& o = given->options;
    CLI::App* command = colours_verb.add_subcommand(
        "learn", "Learn a table from ordinary pictures of a pitch, without anybody marking anything");
    command
        ->add_option("PICTURES", o.pictures,
                     "pictures (PNG, JPEG, PPM, raw 4:2:2 as .yuyv), folders of them, or LCM logs that hold "
                     "pictures; ten with some goalposts in them will do")
        ->required();
    command->add_option("-o,--output", o.output, "Colour table to write (.gmct)")->required();
    command->add_option(
        "--field", o.field,
        "field description (config/fields): says whether goals are yellow or white; else yellow");
    command->add_option(
        "--report", o.report,
        "folder for a page with what was learnt, and pictures: contact_sheet.png, clusters.png, "
        "table.png");
    command->add_option("--most", o.most, "of more pictures than that, so many evenly spread are used")
        ->check(CLI::Range(1, 10000).description(""))
        ->capture_default_str();
    command->add_option("--bits", o.bits, "Bits an axis")->check(CLI::Range(5, 8))->capture_default_str();
    command->add_option("--name", o.name, "Name of the table; default: the output's");
    command->add_option("--size", given->size, "WIDTHxHEIGHT of raw pictures [px]");
    command->footer(
        "Looks for the field's green, lines on it, what stands on it as goalposts do, and balls on it. Where "
        "there "
        "is no\nfield or no goalpost in the pictures it says so (exit code 2), and a table that was there "
        "stays as "
        "it was.");
    sets_action(command, action, [given] {
        given->options.size = size_given(given->size);
        return learn_colours(given->options);
    });
}

}  // namespace goalmouth
