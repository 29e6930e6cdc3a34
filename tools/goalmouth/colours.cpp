#include "core/imaging/colour_picture.h"
#include "core/imaging/colour_rules.h"
#include "core/imaging/colour_table_file.h"
#include "core/imaging/file_error.h"
#include "core/imaging/image_file.h"
#include "core/process/configuration.h"
#include "tools/goalmouth/colours_rules.h"
#include "tools/goalmouth/colours_train.h"
#include "tools/goalmouth/file_action.h"
#include "tools/goalmouth/output.h"
#include "tools/goalmouth/verbs.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace goalmouth {

namespace {

namespace fs = std::filesystem;

struct Options {
    fs::path table;
    fs::path output;
    std::vector<fs::path> images;
    std::string size;
    std::string format;
    std::string name;
    int bits = 0;
    std::string fold;
    TrainColoursOptions train;
};

void print_table(const ColourTable& table) {
    std::printf("name     %s\nbits     %d (%zu entries)\n", table.name().c_str(), table.bits(),
                table.entries().size());
    for (const std::string& line : table.provenance()) std::printf("made     %s\n", line.c_str());
    const auto counts = class_counts(table);
    for (std::size_t c = 0; c < colour_count; ++c) {
        std::printf("%-14s %9zu entries  %6.2f %%\n", std::string(colour_names[c]).c_str(), counts[c],
                    100.0 * static_cast<double>(counts[c]) / static_cast<double>(table.entries().size()));
    }
}

void print_shares(const fs::path& image_file, YuyvView image, const ColourTable& table,
                  const fs::path& written) {
    std::array<std::size_t, colour_count> counts{};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) ++counts[static_cast<std::size_t>(table.at(image.at(x, y)))];
    std::printf("%s:", image_file.c_str());
    for (std::size_t c = 1; c < colour_count; ++c) {
        std::printf(
            " %s %.2f %%", std::string(colour_names[c]).c_str(),
            100.0 * static_cast<double>(counts[c]) / (static_cast<double>(image.width) * image.height));
    }
    std::printf(" -> %s\n", written.c_str());
}

int segment(const Options& o) {
    const ColourTable table = load_colour_table(o.table);
    std::optional<ImageSize> size;
    if (!o.size.empty()) {
        size = parse_image_size(o.size);
        if (!size)
            throw ConfigurationError("--size must be WIDTHxHEIGHT, e.g. 640x480, not \"" + o.size + "\"");
    }
    make_output_folder(o.output, "--output");
    int failed = 0;
    for (const fs::path& file : o.images) {
        try {
            const YuyvImage image = read_image(file, size);
            const fs::path out = o.output / (file.stem().string() + "_segmented.png");
            write_picture(out, segmentation_beside_image(image.view(), table), "");
            print_shares(file, image.view(), table, out);
        } catch (const FileError& error) {
            std::cerr << "goalmouth: " << error.what() << '\n';
            ++failed;
        }
    }
    if (failed > 0)
        throw ConfigurationError(std::to_string(failed) + " of " + std::to_string(o.images.size()) +
                                 " images could not be used");
    return 0;
}

int import_table(const Options& o) {
    const auto format = foreign_format(o.format);
    ColourTable table = import_colour_table(*format, o.images.front());
    if (!o.name.empty()) table.set_name(o.name);
    if (o.bits != 0) table = resampled(table, o.bits);
    save_colour_table(table, o.output);
    print_table(table);
    return 0;
}

int make(const Options& o) {
    const fs::path& file = o.images.front();
    const ColourRuleFile rules = load_colour_rules(file);
    ColourTable table = table_from_rules(rules.rules, o.bits != 0 ? o.bits : rules.bits,
                                         o.name.empty() ? rules.name : o.name);
    table.add_provenance("from the " + std::to_string(rules.rules.size()) + " rules of " +
                         file.filename().string());
    save_colour_table(table, o.output);
    print_table(table);
    return 0;
}

void add_show(CLI::App& verb, Action& action) {
    auto o = std::make_shared<Options>();
    CLI::App* command = verb.add_subcommand("show", "Draw a table as slices of the chroma plane");
    command->add_option("TABLE", o->table, "Colour table (.gmct)")->required();
    command->add_option("-o,--output", o->output,
                        "Picture to write; default: the table's name with .png, in the current folder");
    sets_action(command, action, [o] {
        const ColourTable table = load_colour_table(o->table);
        const fs::path out = o->output.empty() ? fs::path(o->table.stem().string() + ".png") : o->output;
        write_picture(out, table_picture(table), "");
        print_table(table);
        std::printf("picture  %s\n", out.c_str());
        return 0;
    });
}

void add_segment(CLI::App& verb, Action& action) {
    auto o = std::make_shared<Options>();
    o->output = ".";
    CLI::App* command = verb.add_subcommand("segment", "Draw images beside what a table makes of them");
    command->add_option("TABLE", o->table, "Colour table (.gmct)")->required();
    command->add_option("IMAGE", o->images, "PNG, JPEG, PPM, or raw 4:2:2 (.yuyv, with --size)")->required();
    command->add_option("--size", o->size, "Size of raw images, e.g. 640x480");
    command
        ->add_option("-o,--output", o->output, "Folder for the pictures IMAGE_segmented.png (made if absent)")
        ->capture_default_str();
    sets_action(command, action, [o] { return segment(*o); });
}

void add_import(CLI::App& verb, Action& action) {
    auto o = std::make_shared<Options>();
    CLI::App* command = verb.add_subcommand("import", "Convert another team's table into ours");
    command->add_option("FORMAT", o->format, "nubots_2013 (.lut, 2 MiB) or gmu_2014 (.raw, 256 KiB)")
        ->required()
        ->check(CLI::IsMember(foreign_format_names()));
    command->add_option("FILE", o->images, "The table")->required()->expected(1);
    command->add_option("-o,--output", o->output, "Colour table to write (.gmct)")->required();
    command->add_option("--name", o->name, "Its name; default: the file's");
    command->add_option("--bits", o->bits, "Bits an axis; default: as the file has them")
        ->check(CLI::Range(5, 8));
    sets_action(command, action, [o] { return import_table(*o); });
}

void add_train(CLI::App& verb, Action& action) {
    auto o = std::make_shared<Options>();
    CLI::App* command =
        verb.add_subcommand("train", "Learn a table from pictures in which the goalposts are annotated");
    command->footer(
        "Goal is learnt inside the annotated posts; field is the large green area, lines the pale bright "
        "parts and\n"
        "balls the orange blobs in it. Prints how many pixels of posts, and of anything else, the table "
        "calls goal.");
    TrainColoursOptions& t = o->train;
    command
        ->add_option("--annotations", t.annotations,
                     "Annotation file (JSON); its pictures lie relative to it")
        ->required();
    command->add_option("--set", t.set, "Which set of the annotation file")->required();
    command->add_option("--fold", o->fold,
                        "I/N: leave out every picture whose place in the set, ordered by name from 0, is I "
                        "modulo N, and measure on those");
    command->add_option("IMAGES", t.images,
                        "Only these pictures (files or folders) of the set; default: all of it");
    command->add_option("-o,--output", t.output, "Colour table to write (.gmct)")->required();
    command->add_option("--bits", t.bits, "Bits an axis")->check(CLI::Range(5, 8))->capture_default_str();
    command->add_option("--name", t.name, "Name of the table; default: the output's");
    command->add_option("--parameters", t.parameters,
                        "YAML file with settings of the classifier (docs/colour_tables.md)");
    command->add_option("--labels", t.labels,
                        "Folder for pictures of the labels learnt from, to check them by eye");
    sets_action(command, action, [o] {
        if (!o->fold.empty()) {
            o->train.fold = parse_fold(o->fold);
            if (!o->train.fold)
                throw ConfigurationError("--fold must be I/N with 0 <= I < N and N >= 2, e.g. 0/4, not \"" +
                                         o->fold + "\"");
        }
        return train_colours(o->train);
    });
}

void add_make(CLI::App& verb, Action& action) {
    auto o = std::make_shared<Options>();
    CLI::App* command =
        verb.add_subcommand("make", "Make a table from a file of rules (docs/colour_tables.md)");
    command->add_option("RULES", o->images, "Rule file (YAML)")->required()->expected(1);
    command->add_option("-o,--output", o->output, "Colour table to write (.gmct)")->required();
    command->add_option("--name", o->name, "Its name; default: as the rules say");
    command->add_option("--bits", o->bits, "Bits an axis; default: as the rules say")
        ->check(CLI::Range(5, 8));
    sets_action(command, action, [o] { return make(*o); });
}

void add_info(CLI::App& verb, Action& action) {
    auto o = std::make_shared<Options>();
    CLI::App* command = verb.add_subcommand("info", "Print a table's name, fineness, origin and classes");
    command->add_option("TABLE", o->table, "Colour table (.gmct)")->required();
    sets_action(command, action, [o] {
        print_table(load_colour_table(o->table));
        return 0;
    });
}

void add_convert(CLI::App& verb, Action& action) {
    auto o = std::make_shared<Options>();
    CLI::App* command = verb.add_subcommand("convert", "Make a table finer or coarser");
    command->add_option("TABLE", o->table, "Colour table (.gmct)")->required();
    command->add_option("--bits", o->bits, "Bits an axis")->required()->check(CLI::Range(5, 8));
    command->add_option("-o,--output", o->output, "Colour table to write (.gmct)")->required();
    sets_action(command, action, [o] {
        const ColourTable table = resampled(load_colour_table(o->table), o->bits);
        save_colour_table(table, o->output);
        print_table(table);
        return 0;
    });
}

}  // namespace

CLI::App* add_colours_verb(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand(
        "colours", "Make, show and convert colour tables, and see what they make of images");
    verb->require_subcommand(1);
    add_show(*verb, action);
    add_segment(*verb, action);
    add_info(*verb, action);
    add_make(*verb, action);
    add_train(*verb, action);
    add_import(*verb, action);
    add_convert(*verb, action);
    return verb;
}

}  // namespace goalmouth
