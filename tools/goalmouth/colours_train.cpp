#include "tools/goalmouth/colours_train.h"

#include "core/imaging/colour_picture.h"
#include "core/imaging/colour_table_file.h"
#include "core/imaging/conversion.h"
#include "core/imaging/image_file.h"
#include "core/process/configuration.h"
#include "tools/goalmouth/output.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <set>

#include <opencv2/core.hpp>

namespace goalmouth {

namespace {

struct Set {
    std::vector<AnnotatedImage> trained;
    std::vector<AnnotatedImage> left_out;
};

/// The files asked for, folders opened.
std::vector<std::filesystem::path> wanted_files(const std::vector<std::filesystem::path>& given) {
    std::vector<std::filesystem::path> files;
    for (const auto& path : given) {
        if (!std::filesystem::exists(path))
            throw ConfigurationError(path.string() + ": no such file or folder");
        if (!std::filesystem::is_directory(path)) {
            files.push_back(path);
            continue;
        }
        for (const auto& entry : std::filesystem::directory_iterator(path))
            if (is_image_name(entry.path())) files.push_back(entry.path());
    }
    return files;
}

/// Pictures are told apart by folder and name, wherever the set itself lies.
std::string key_of(const std::filesystem::path& file) {
    const auto whole = std::filesystem::absolute(file).lexically_normal();
    return (whole.parent_path().filename() / whole.filename()).string();
}

Set choose(const TrainColoursOptions& options) {
    std::vector<AnnotatedImage> annotated = Annotations(options.annotations).pictures(options.set);
    std::set<std::string> wanted;
    for (const auto& file : wanted_files(options.images)) {
        const auto same = [&](const AnnotatedImage& a) { return key_of(a.file) == key_of(file); };
        const auto found = std::find_if(annotated.begin(), annotated.end(), same);
        if (found == annotated.end()) {
            throw ConfigurationError(file.string() + ": " + options.annotations.string() +
                                     " says nothing about it in set \"" + options.set + "\"");
        }
        found->file = file;
        wanted.insert(key_of(file));
    }
    std::erase_if(annotated, [](const AnnotatedImage& a) { return a.excluded; });
    Set set;
    for (std::size_t i = 0; i < annotated.size(); ++i) {
        if (!wanted.empty() && !wanted.contains(key_of(annotated[i].file))) continue;
        const bool leave_out = options.fold && options.fold->holds(i);
        (leave_out ? set.left_out : set.trained).push_back(annotated[i]);
    }
    return set;
}

std::vector<LabelledScene> load_scenes(const std::vector<AnnotatedImage>& annotated) {
    std::vector<LabelledScene> scenes;
    for (const AnnotatedImage& image : annotated) scenes.push_back(load_scene(image));
    return scenes;
}

void write_label_picture(const std::filesystem::path& folder, const AnnotatedImage& annotated,
                         const LabelledScene& scene, const cv::Mat& labels) {
    cv::Mat picture(labels.size(), CV_8UC3, cv::Scalar(200, 0, 200));
    for (int y = 0; y < labels.rows; ++y)
        for (int x = 0; x < labels.cols; ++x)
            if (const std::uint8_t label = labels.at<std::uint8_t>(y, x); label < colour_count)
                picture.at<cv::Vec3b>(y, x) = display_colour(static_cast<Colour>(label));
    cv::Mat beside;
    cv::hconcat(bgr_from_yuyv(scene.image.view()), picture, beside);
    make_output_folder(folder, "--labels");
    write_picture(folder / (annotated.file.stem().string() + "_labels.png"), beside, "--labels");
}

void print_score(const char* which, const std::vector<LabelledScene>& scenes, const ColourTable& table) {
    GoalColourScore score;
    double worst = 1.0;
    for (const LabelledScene& scene : scenes) {
        const GoalColourScore one = score_goal_colour(scene, table);
        if (one.inside > 0)
            worst = std::min(worst, static_cast<double>(one.inside_goal) / static_cast<double>(one.inside));
        score += one;
    }
    if (scenes.empty()) return;
    const auto percent = [](std::int64_t part, std::int64_t whole) {
        return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::int64_t>(whole, 1));
    };
    std::printf("%-10s %3zu pictures: ", which, scenes.size());
    if (score.inside > 0) {
        std::printf("%.1f %% of post pixels are goal (%.1f %% in the worst picture), ",
                    percent(score.inside_goal, score.inside), 100.0 * worst);
    } else {
        std::printf("no post in them, ");
    }
    std::printf("%.3f %% of pixels elsewhere\n", percent(score.elsewhere_goal, score.elsewhere));
}

}  // namespace

ColourTrainer learn_colours(std::span<const LabelledScene> scenes, const ColourTrainingParameters& parameters,
                            const std::string& what,
                            const std::function<void(std::size_t, const cv::Mat&)>& each) {
    ColourTrainer trainer(parameters);
    try {
        const ChromaRegion field = find_field_colour(scenes);
        const ChromaRegion goal = find_goal_colour(scenes);
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            const cv::Mat labels = label_scene(scenes[i], field, goal);
            trainer.add(scenes[i].image.view(), labels);
            if (each) each(i, labels);
        }
    } catch (const std::invalid_argument& error) {
        throw ConfigurationError(what + ": cannot train on these " + std::to_string(scenes.size()) +
                                 " pictures: " + error.what());
    }
    return trainer;
}

int train_colours(const TrainColoursOptions& options) {
    expect_writable(options.output, "--output");
    const auto parameters = options.parameters.empty()
                                ? ColourTrainingParameters{}
                                : load_parameters<ColourTrainingParameters>(options.parameters);
    const Set set = choose(options);
    const std::vector<LabelledScene> scenes = load_scenes(set.trained);

    const ColourTrainer trainer = learn_colours(
        scenes, parameters, "set \"" + options.set + "\"", [&](std::size_t i, const cv::Mat& labels) {
            if (!options.labels.empty())
                write_label_picture(options.labels, set.trained[i], scenes[i], labels);
        });
    ColourTable table =
        trainer.table(options.bits, options.name.empty() ? options.output.stem().string() : options.name);
    std::string made = "trained on " + std::to_string(scenes.size()) + " pictures of " + options.set;
    if (options.fold) {
        made += ", without fold " + std::to_string(options.fold->index) + "/" +
                std::to_string(options.fold->count) + " (" + std::to_string(set.left_out.size()) +
                " pictures)";
    }
    table.add_provenance(made);
    save_colour_table(table, options.output);

    const auto counts = class_counts(table);
    std::printf("%s: %s\n%-14s %12s %10s\n", options.output.c_str(), made.c_str(), "class", "samples",
                "entries");
    for (std::size_t c = 0; c < colour_count; ++c)
        std::printf("%-14s %12.0f %10zu\n", std::string(colour_names[c]).c_str(), trainer.samples()[c],
                    counts[c]);
    print_score("trained on", scenes, table);
    print_score("left out", load_scenes(set.left_out), table);
    return 0;
}

}  // namespace goalmouth
