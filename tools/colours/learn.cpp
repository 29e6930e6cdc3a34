#include "tools/colours/learn.h"

#include "core/colour_learning/colour_learner.h"
#include "core/field/field.h"
#include "core/imaging/colour_table_file.h"
#include "core/imaging/file_error.h"
#include "core/process/configuration.h"
#include "tools/colours/learn_report.h"
#include "tools/colours/learning_pictures.h"
#include "tools/evaluate/report/report_folder.h"
#include "tools/goalmouth/output.h"

#include <fmt/format.h>
#include <iostream>

namespace goalmouth {

namespace {

std::string provenance(const LearnColoursOptions& options, const std::vector<NamedPicture>& pictures,
                       const Field& field) {
    std::string from = pictures.front().name;
    if (pictures.size() > 1) from += " … " + pictures.back().name;
    return fmt::format("learnt without labels from {} pictures ({}) of a field with {} goals",
                       pictures.size(), from, field.goal_colour) +
           (options.field.empty() ? "" : " (" + options.field.filename().string() + ")");
}

std::string percent(const std::optional<double>& share) {
    return share ? fmt::format("{:.1f} %", 100.0 * *share) : "–";
}

std::string classes_text(const LearntColours& learnt) {
    std::string text = fmt::format("{:<14} {:>9} {:>10} {:>16} {:>9} {:>10} {:>11}\n", "class", "pictures",
                                   "pixels", "mean Y Cb Cr", "recall", "precision", "confidence");
    for (std::size_t c = 0; c < colour_count; ++c) {
        const LearntClass& k = learnt.classes[c];
        if (k.samples == 0.0) {
            text += fmt::format("{:<14} not found\n", colour_names[c]);
            continue;
        }
        text += fmt::format("{:<14} {:>9} {:>10.0f} {:>16} {:>9} {:>10} {:>11.2f}\n", colour_names[c],
                            k.pictures, k.samples, fmt::format("{} {} {}", k.mean.y, k.mean.cb, k.mean.cr),
                            percent(k.recall), percent(k.precision), k.confidence());
    }
    return text;
}

std::size_t posts_in(const LearntColours& learnt) {
    std::size_t posts = 0;
    for (const LearntPicture& picture : learnt.pictures) posts += picture.scene.posts.size();
    return posts;
}

}  // namespace

int learn_colours(const LearnColoursOptions& options) {
    expect_writable(options.output, "--output");
    if (!options.report.empty()) expect_report_folder(options.report);
    const Field field = options.field.empty() ? Field{} : load_parameters<Field>(options.field);
    const std::vector<NamedPicture> pictures =
        learning_pictures(options.pictures, options.size, options.most);
    std::vector<YuyvImage> images;
    for (const NamedPicture& picture : pictures) images.push_back(picture.image);

    LearntColours learnt;
    try {
        learnt = learn_without_labels(images, goal_paint(field.goal_colour), options.bits,
                                      options.name.empty() ? options.output.stem().string() : options.name);
    } catch (const NothingToLearn& error) {
        throw ConfigurationError(std::string(error.what()) + "; " + options.output.string() +
                                 " is not written");
    }
    learnt.table.add_provenance(provenance(options, pictures, field));
    std::string confidences;
    for (std::size_t c = 1; c < colour_count; ++c) {
        if (learnt.classes[c].samples > 0.0)
            confidences += fmt::format("{}{} {:.2f}", confidences.empty() ? "" : ", ", colour_names[c],
                                       learnt.classes[c].confidence());
    }
    learnt.table.add_provenance("confidence: " + confidences);
    save_colour_table(learnt.table, options.output);
    if (!options.report.empty()) write_learn_report(options, pictures, learnt);

    fmt::print(
        "{}: {}\n{} goalposts in them; {:.1f} % of the pixels of their first guessed colour were theirs\n{}",
        options.output.string(), learnt.table.provenance().front(), posts_in(learnt),
        100.0 * learnt.goal.salience, classes_text(learnt));
    return 0;
}

}  // namespace goalmouth
