#include "tools/evaluate/images_run.h"

#include "core/colour_learning/colour_learner.h"
#include "core/imaging/colour_table_file.h"
#include "core/imaging/file_error.h"
#include "core/process/configuration.h"
#include "core/process/paths.h"
#include "tools/evaluate/parallel.h"
#include "tools/goalmouth/colours_train.h"
#include "tools/goalmouth/temporary_folder.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

fs::path table_of_fold(const TemporaryFolder& tables, int fold) {
    return tables.path() / (std::to_string(fold) + ".gmct");
}
Annotations read_annotations(const ImagesOptions& options) {
    if (!fs::exists(options.folder)) throw ConfigurationError(options.folder.string() + ": no such folder");
    if (!fs::is_directory(options.folder))
        throw ConfigurationError(options.folder.string() + ": is a file; a folder of pictures is needed");
    fs::path file = options.annotations;
    if (file.empty()) {
        file = options.folder / "annotations.json";
        if (!fs::exists(file)) {
            throw ConfigurationError(
                options.folder.string() +
                (fs::is_empty(options.folder) ? ": is empty" : ": there is no annotations.json in it") +
                "; the posts to be found are read from annotations.json there or from --annotations FILE");
        }
    }
    try {
        return Annotations(file, options.folder);
    } catch (const FileError& error) {
        throw ConfigurationError(error.what());
    }
}

std::vector<std::string> chosen_sets(const ImagesOptions& options, const Annotations& annotations) {
    if (options.sets.empty()) {
        std::vector<std::string> sets = annotations.sets();
        std::erase_if(sets, [&](const std::string& set) { return annotations.usable_pictures(set).empty(); });
        return sets;
    }
    for (const std::string& set : options.sets) {
        if (annotations.usable_pictures(set).empty()) {
            throw ConfigurationError(annotations.file().string() + ": every picture of set \"" + set +
                                     "\" is excluded");
        }
    }
    return options.sets;
}

LabelledScene read_scene(const AnnotatedImage& annotated, const Annotations& annotations) {
    if (!fs::exists(annotated.file)) {
        throw ConfigurationError(annotations.file().string() + ": names " + annotated.name +
                                 ", but there is no file " + annotated.file.string());
    }
    try {
        return load_scene(annotated);
    } catch (const FileError& error) {
        throw ConfigurationError(error.what());
    }
}

/// What is given for the set, else for all, else the set's own file in that folder of config/, else nothing.
fs::path file_of(const std::map<std::string, fs::path>& given, const std::string& set,
                 const std::string& folder) {
    if (const auto found = given.find(set); found != given.end()) return found->second;
    if (const auto found = given.find(""); found != given.end()) return found->second;
    const fs::path own = config_folder() / folder / (set + ".yaml");
    return fs::exists(own) ? own : fs::path();
}

/// Where robots' places are known there must be goals.
fs::path field_of(const ImagesOptions& options, const std::string& set) {
    const fs::path file = file_of(options.fields, set, "fields");
    if (!file.empty() || !options.poses.contains(set)) return file;
    return config_folder() / "fields/kidsize_2013.yaml";
}

/// By picture; empty for a set of which none is known.
std::vector<RobotPlace> places_of(const std::vector<AnnotatedImage>& pictures, const std::string& set,
                                  const ImagesOptions& options) {
    std::vector<RobotPlace> places;
    const auto given = options.poses.find(set);
    if (given == options.poses.end()) return places;
    const PlacePattern pattern(given->second);
    for (const AnnotatedImage& picture : pictures) {
        const auto place = pattern.place(picture.name);
        if (!place) {
            throw ConfigurationError("--poses: " + picture.name + " does not fit the pattern \"" +
                                     pattern.text() + "\" of set \"" + set +
                                     "\"; a name that does: " + pattern.example());
        }
        places.push_back(*place);
    }
    return places;
}

void expect_files(const std::map<std::string, fs::path>& files, const Annotations& annotations,
                  const std::string& option) {
    for (const auto& [set, file] : files) {
        if (!set.empty()) annotations.pictures(set);  // says so where there is no such set
        if (!fs::exists(file)) throw ConfigurationError(option + ": there is no file " + file.string());
    }
}

ColourTable learnt_table(std::span<const LabelledScene> scenes, const std::string& set,
                         const std::string& name, const ImagesOptions& options, const fs::path& field) {
    if (!options.without_labels) return learn_colours(scenes, {}, "set \"" + set + "\"").table(6, name);
    std::vector<YuyvImage> pictures;
    for (const LabelledScene& scene : scenes) pictures.push_back(scene.image);
    const Field goals = field.empty() ? Field{} : load_parameters<Field>(field);
    try {
        return learn_without_labels(pictures, goal_paint(goals.goal_colour), 6, name).table;
    } catch (const NothingToLearn& error) {
        throw ConfigurationError("set \"" + set + "\": " + error.what());
    }
}

void learn_tables(const std::vector<LabelledScene>& scenes, const std::string& set,
                  const ImagesOptions& options, const fs::path& field, const TemporaryFolder& folder,
                  const std::function<bool()>& stop) {
    for_each_in_parallel(
        static_cast<std::size_t>(options.folds), options.jobs,
        [&](std::size_t, std::size_t fold) {
            const Fold left_out{static_cast<int>(fold), options.folds};
            std::vector<LabelledScene> others;
            for (std::size_t i = 0; i < scenes.size(); ++i)
                if (!left_out.holds(i)) others.push_back(scenes[i]);
            save_colour_table(
                learnt_table(others, set, set + " without fold " + std::to_string(fold), options, field),
                table_of_fold(folder, left_out.index));
        },
        stop);
}

/// The chains of one thread, each made when it is needed first.
class Chains {
  public:
    Chains(const ImagesOptions& options, fs::path camera, fs::path field, const TemporaryFolder& tables)
        : options_(options), camera_(std::move(camera)), field_(std::move(field)), tables_(tables) {}

    ImageChain& chain(const std::string& detector, std::size_t place) {
        const int fold = options_.colours.empty() ? static_cast<int>(place) % options_.folds : 0;
        std::unique_ptr<ImageChain>& chain = chains_[{detector, fold}];
        if (!chain) {
            ImageChainOptions chain_options;
            chain_options.graph = detector;
            chain_options.camera = camera_;
            chain_options.field = field_;
            if (takes_colours(detector)) {
                chain_options.colours =
                    options_.colours.empty() ? table_of_fold(tables_, fold) : options_.colours;
            }
            chain = std::make_unique<ImageChain>(chain_options);
        }
        return *chain;
    }

  private:
    const ImagesOptions& options_;
    fs::path camera_;
    fs::path field_;
    const TemporaryFolder& tables_;
    std::map<std::pair<std::string, int>, std::unique_ptr<ImageChain>> chains_;
};

ImageSetResult evaluate_set(const std::string& set, const std::vector<AnnotatedImage>& annotated,
                            const Annotations& annotations, const ImagesOptions& options,
                            const ImagesProgress& progress) {
    ImageSetResult result;
    result.set = set;
    result.camera = file_of(options.cameras, set, "cameras");
    result.field = field_of(options, set);
    const std::vector<RobotPlace> places = places_of(annotated, set, options);
    if (!places.empty()) result.goals = load_parameters<Field>(result.field);
    std::vector<LabelledScene> scenes;
    for (const AnnotatedImage& image : annotated) scenes.push_back(read_scene(image, annotations));
    const TemporaryFolder tables;
    if (options.colours.empty() &&
        std::any_of(options.detectors.begin(), options.detectors.end(), takes_colours))
        learn_tables(scenes, set, options, result.field, tables, progress.stop);

    std::vector<Chains> workers;
    for (int i = 0; i < options.jobs; ++i) workers.emplace_back(options, result.camera, result.field, tables);
    std::vector<std::vector<ScoredPicture>> by_place(annotated.size());
    for_each_in_parallel(
        annotated.size(), options.jobs,
        [&](std::size_t worker, std::size_t place) {
            const YuyvView image = scenes[place].image.view();
            for (const std::string& detector : options.detectors) {
                ImageResult found = workers[worker].chain(detector, place).run({.image = image});
                by_place[place].push_back(
                    score_picture(annotated[place], detector, std::move(found), image.height));
                if (result.goals) place_picture(by_place[place].back(), places[place], *result.goals);
            }
            if (progress.step) progress.step();
        },
        progress.stop);
    for (std::vector<ScoredPicture>& pictures : by_place) {
        if (pictures.empty()) result.complete = false;
        std::move(pictures.begin(), pictures.end(), std::back_inserter(result.pictures));
    }
    return result;
}

}  // namespace

std::vector<const ScoredPicture*> ImageSetResult::of(const std::string& detector) const {
    std::vector<const ScoredPicture*> chosen;
    for (const ScoredPicture& picture : pictures)
        if (picture.detector == detector) chosen.push_back(&picture);
    return chosen;
}

ImageScore ImageSetResult::score(const std::string& detector) const {
    ImageScore sum;
    for (const ScoredPicture* picture : of(detector)) sum += *picture;
    return sum;
}

std::vector<MeasuredPost> ImageSetResult::measured(const std::string& detector) const {
    return measured_posts(of(detector));
}

std::vector<DistanceGroup> ImageSetResult::distances(const std::vector<std::string>& detectors) const {
    std::vector<DistanceGroup> all;
    if (!goals || detectors.empty()) return all;
    all.push_back({"", "all", outline_samples(of(detectors.front()), goals->post_diameter)});
    for (const std::string& detector : detectors)
        for (const MeasuredGroup& group : groups(measured(detector)))
            all.push_back({detector, group.name, distance_samples(group.posts)});
    return all;
}

std::vector<std::string> sets_of(const ImagesOptions& options) {
    return chosen_sets(options, read_annotations(options));
}

std::size_t pictures_of(const ImagesOptions& options) {
    const Annotations annotations = read_annotations(options);
    std::size_t count = 0;
    for (const std::string& set : chosen_sets(options, annotations))
        count += annotations.usable_pictures(set).size();
    return count;
}

ColourTable table_of_set(const ImagesOptions& options, const std::string& set) {
    const Annotations annotations = read_annotations(options);
    std::vector<LabelledScene> scenes;
    for (const AnnotatedImage& image : annotations.usable_pictures(set))
        scenes.push_back(read_scene(image, annotations));
    return learnt_table(scenes, set, set, options, field_of(options, set));
}

std::vector<ImageSetResult> evaluate_images(const ImagesOptions& options, const ImagesProgress& progress) {
    const Annotations annotations = read_annotations(options);
    const std::vector<std::string> sets = chosen_sets(options, annotations);
    expect_files(options.cameras, annotations, "--camera");
    expect_files(options.fields, annotations, "--field");
    for (const auto& [set, pattern] : options.poses)
        places_of(annotations.usable_pictures(set), set, options);
    std::vector<std::vector<AnnotatedImage>> pictures;
    std::size_t count = 0;
    for (const std::string& set : sets) {
        pictures.push_back(annotations.usable_pictures(set));
        count += pictures.back().size();
    }
    if (progress.expect) progress.expect(count);
    std::vector<ImageSetResult> results;
    for (std::size_t i = 0; i < sets.size() && !(progress.stop && progress.stop()); ++i)
        results.push_back(evaluate_set(sets[i], pictures[i], annotations, options, progress));
    return results;
}

}  // namespace goalmouth
