#include "tools/colours/colours.h"

#include "tools/colours/learn.h"
#include "tools/colours/teach.h"
#include "tools/goalmouth/file_action.h"

#include <memory>
#include <optional>
#include <string>

namespace goalmouth {

namespace {

std::optional<ImageSize> size_given(const std::string& text) {
    if (text.empty()) return std::nullopt;
    const auto size = parse_image_size(text);
    if (!size) throw ConfigurationError("--size: \"" + text + "\" is no size such as 640x480");
    return size;
}

void add_teach(CLI::App& colours_verb, Action& action) {
    struct Given {
        TeachColoursOptions options;
        std::string size;
    };
    const auto given = std::make_shared<Given>();
    TeachColoursOptions& o = given->options;
    CLI::App* command =
        colours_verb.add_subcommand("teach", "Make a table from boxes in pictures, each of one class");
    command->add_option("BOXES", o.boxes, "text file with a box a line: PICTURE CLASS X0 Y0 X1 Y1 [px]")
        ->required();
    command->add_option("-o,--output", o.output, "Colour table to write (.gmct)")->required();
    command->add_option("--bits", o.bits, "Bits an axis")->check(CLI::Range(5, 8))->capture_default_str();
    command->add_option("--name", o.name, "Name of the table; default: the output's");
    command->add_option("--size", given->size, "WIDTHxHEIGHT of raw pictures [px]");
    command->footer(
        "Pictures lie relative to BOXES; corners are inclusive, 0 0 is a picture's first pixel; # begins a "
        "remark. "
        "Classes:\nunclassified, field, line, ball, goal, robot. Boxes of \"unclassified\" say what none of "
        "them is.");
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
