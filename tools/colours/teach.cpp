#include "tools/colours/teach.h"

#include "core/colour_teaching/teaching_session.h"
#include "core/imaging/colour_table_file.h"
#include "core/imaging/file_error.h"
#include "core/process/configuration.h"
#include "tools/colours/display_check.h"
#include "tools/colours/marked_pictures.h"
#include "tools/colours/teach_editor.h"
#include "tools/colours/teach_window.h"
#include "tools/goalmouth/interrupt.h"
#include "tools/goalmouth/output.h"

#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <utility>

namespace goalmouth {

namespace {

namespace fs = std::filesystem;

/// Throws where writing `output` would take away one of the inputs.
void expect_other_than(const fs::path& output, const char* option, const std::vector<std::string>& inputs) {
    for (const std::string& input : inputs)
        if (fs::weakly_canonical(input) == fs::weakly_canonical(output))
            throw ConfigurationError(
                fmt::format("{}: {} is what to teach from; it would be overwritten", option, input));
}

/// A text file, that is: neither a picture nor a folder nor a log.
bool is_marks_file(const std::string& name) {
    return fs::is_regular_file(name) && !is_image_name(name) && !is_log_file(name);
}

std::vector<ColourMark> marks_of(const TeachingSession& session) {
    std::vector<ColourMark> marks;
    for (const auto& each : session.marks()) marks.push_back(each->mark);
    return marks;
}

TeachingSession session_of(MarkedPictures& marked, int bits) {
    std::vector<YuyvImage> images;
    for (NamedPicture& picture : marked.pictures) images.push_back(std::move(picture.image));
    if (std::all_of(images.begin(), images.end(),
                    [](const YuyvImage& image) { return is_black(image.view()); }))
        throw ConfigurationError(images.size() == 1
                                     ? "the picture is black: there is nothing to teach from"
                                     : fmt::format("all {} pictures are black: there is nothing to "
                                                   "teach from",
                                                   images.size()));
    return TeachingSession(std::move(images), bits, marked.marks);
}

std::string origin(const TeachingSession& session, const fs::path& marks) {
    const std::size_t count = session.marks().size();
    return fmt::format("taught by the {}{} of {}", count == 1 ? "" : std::to_string(count) + " ",
                       count == 1 ? "mark" : "marks", marks.filename().string());
}

/// Throws ConfigurationError where the marks make no table; nothing is written then.
void save_table(const TeachingSession& session, const TeachColoursOptions& options, const fs::path& marks) {
    if (const std::string problem = session.problem(); !problem.empty())
        throw ConfigurationError(problem + "; " + options.output.string() + " is not written");
    ColourTable table = *session.table();
    table.set_name(options.name.empty() ? options.output.stem().string() : options.name);
    table.add_provenance(origin(session, marks));
    try {
        save_colour_table(table, options.output);
    } catch (const FileError& error) {
        throw ConfigurationError(error.what());
    }
}

void print_classes(const TeachingSession& session, const fs::path& output, const fs::path& marks) {
    fmt::print("{}: {}\n{:<14} {:>9} {:>10}\n", output.string(), origin(session, marks), "class", "pixels",
               "come back");
    ClassSamples samples;
    for (const auto& each : session.marks()) {
        auto& of_class = samples[static_cast<std::size_t>(each->mark.colour)];
        of_class.insert(of_class.end(), each->colours.begin(), each->colours.end());
    }
    for (std::size_t c = 0; c < colour_count; ++c) {
        if (samples[c].empty()) continue;
        fmt::print("{:<14} {:>9} {:>8.1f} %\n", colour_names[c], pixels_of(samples[c]),
                   100.0 * shares_by_class(samples[c], *session.table())[c]);
    }
}

int teach_by_file(const TeachColoursOptions& options) {
    const fs::path file = options.inputs.front();
    MarkedPictures marked;
    add_marks(marked, read_marks(file), file, options.size);
    const TeachingSession session = session_of(marked, options.bits);
    save_table(session, options, file);
    print_classes(session, options.output, file);
    return 0;
}

int teach_in_window(const TeachColoursOptions& options) {
    fs::path file = options.marks;
    if (file.empty()) file = fs::path(options.output).replace_extension(".marks");
    if (fs::weakly_canonical(file) == fs::weakly_canonical(options.output))
        throw ConfigurationError("--marks: " + file.string() +
                                 " is the table's name; marks need one of their own");
    expect_other_than(file, "--marks", options.inputs);
    expect_writable(file, "--marks");
    const DisplayCheck display;
    if (!display.problem().empty()) {
        throw ConfigurationError("no window can be opened here: " + display.problem() +
                                 "; write the marks into a text file instead, a line each, PICTURE CLASS X0 "
                                 "Y0 X1 Y1, and give that "
                                 "instead of the pictures");
    }
    MarkedPictures marked;
    marked.pictures = learning_pictures(options.inputs, options.size, options.most);
    if (fs::exists(file)) add_marks(marked, read_marks(file), file, options.size);
    std::vector<std::string> names;
    for (const NamedPicture& picture : marked.pictures) names.push_back(picture.name);
    TeachingSession session = session_of(marked, options.bits);

    bool table_written = false;  // of the marks that were saved last
    TeachEditor editor(session, names, [&] {
        if (session.marks().empty()) throw ConfigurationError(session.problem() + "; nothing is saved");
        write_text(file, marks_text(lines_of(marks_of(session), marked.pictures), file.parent_path()), "");
        session.keep();
        table_written = false;
        try {
            save_table(session, options, file);
        } catch (const ConfigurationError& error) {
            throw ConfigurationError("marks saved, but " + std::string(error.what()));
        }
        table_written = true;
        return fmt::format("saved: {} and {}", options.output.string(), file.string());
    });
    const Interrupt interrupt;
    try {
        run_teach_window(editor, [&] { return interrupt.requested(); });
    } catch (const cv::Exception& error) {
        throw ConfigurationError("the window cannot be shown: " + std::string(error.what()));
    }
    if (session.changed()) std::cerr << "goalmouth: the marks made since they were saved last are given up\n";
    if (interrupt.requested()) return Interrupt::exit_code;
    if (!table_written) {
        fmt::print("{} is not written{}\n", options.output.string(),
                   fs::exists(options.output) ? "; what stands there is from before" : "");
    } else if (!session.changed()) {
        print_classes(session, options.output, file);
    }
    return 0;
}

}  // namespace

int teach_colours(const TeachColoursOptions& options) {
    expect_writable(options.output, "--output");
    for (const std::string& input : options.inputs)
        if (!fs::exists(input)) throw ConfigurationError(input + ": there is no such file or folder");
    expect_other_than(options.output, "--output", options.inputs);
    const auto marks = std::find_if(options.inputs.begin(), options.inputs.end(), is_marks_file);
    if (marks == options.inputs.end()) return teach_in_window(options);
    if (options.inputs.size() > 1 || !options.marks.empty()) {
        throw ConfigurationError(
            *marks +
            ": is neither a picture nor an LCM log; a file of marks stands alone, or, for the "
            "window, after --marks with pictures beside it");
    }
    return teach_by_file(options);
}

}  // namespace goalmouth
