#include "tools/evaluate/images_run.h"

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

fs::path camera_of(const ImagesOptions& options, const std::string& set) {
    if (const auto found = options.cameras.find(set); found != options.cameras.end()) return found->second;
    if (const auto found = options.cameras.find(""); found != options.cameras.end()) return found->second;
    const fs::path own = config_folder() / "cameras" / (set + ".yaml");
    return fs::exists(own) ? own : fs::path();
}

void learn_tables(const std::vector<LabelledScene>& scenes, const std::string& set,
                  const ImagesOptions& options, const TemporaryFolder& folder) {
    for_each_in_parallel(
        static_cast<std::size_t>(options.folds), options.jobs, [&](std::size_t, std::size_t fold) {
            const Fold left_out{static_cast<int>(fold), options.folds};
            std::vector<LabelledScene> others;
            for (std::size_t i = 0; i < scenes.size(); ++i)
                if (!left_out.holds(i)) others.push_back(scenes[i]);
            const ColourTrainer trainer = learn_colours(others, {}, "set \"" + set + "\"");
            save_colour_table(trainer.table(6, set + " without fold " + std::to_string(fold)),
                              table_of_fold(folder, left_out.index));
        });
}

/// The chains of one thread, each made when it is needed first.
class Chains {
  public:
    Chains(const ImagesOptions& options, fs::path camera, const TemporaryFolder& tables)
        : options_(options), camera_(std::move(camera)), tables_(tables) {}

    ImageChain& chain(const std::string& detector, std::size_t place) {
        const int fold = options_.colours.empty() ? static_cast<int>(place) % options_.folds : 0;
        std::unique_ptr<ImageChain>& chain = chains_[{detector, fold}];
        if (!chain) {
            ImageChainOptions chain_options;
            chain_options.graph = detector;
            chain_options.camera = camera_;
            chain_options.colours =
                options_.colours.empty() ? table_of_fold(tables_, fold) : options_.colours;
            chain = std::make_unique<ImageChain>(chain_options);
        }
        return *chain;
    }

  private:
    const ImagesOptions& options_;
    fs::path camera_;
    const TemporaryFolder& tables_;
    std::map<std::pair<std::string, int>, std::unique_ptr<ImageChain>> chains_;
};

ImageSetResult evaluate_set(const std::string& set, const std::vector<AnnotatedImage>& annotated,
                            const Annotations& annotations, const ImagesOptions& options,
                            const ImagesProgress& progress) {
    ImageSetResult result{set, camera_of(options, set), {}, true};
    std::vector<LabelledScene> scenes;
    for (const AnnotatedImage& image : annotated) scenes.push_back(read_scene(image, annotations));
    const TemporaryFolder tables;
    if (options.colours.empty()) learn_tables(scenes, set, options, tables);

    std::vector<Chains> workers;
    for (int i = 0; i < options.jobs; ++i) workers.emplace_back(options, result.camera, tables);
    std::vector<std::vector<ScoredPicture>> by_place(annotated.size());
    for_each_in_parallel(
        annotated.size(), options.jobs,
        [&](std::size_t worker, std::size_t place) {
            const YuyvView image = scenes[place].image.view();
            for (const std::string& detector : options.detectors) {
                ImageResult found = workers[worker].chain(detector, place).run({.image = image});
                by_place[place].push_back(
                    score_picture(annotated[place], detector, std::move(found), image.height));
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

std::vector<ImageSetResult> evaluate_images(const ImagesOptions& options, const ImagesProgress& progress) {
    const Annotations annotations = read_annotations(options);
    const std::vector<std::string> sets = chosen_sets(options, annotations);
    for (const auto& [set, camera] : options.cameras) {
        if (!set.empty()) annotations.pictures(set);  // says so where there is no such set
        if (!fs::exists(camera)) throw ConfigurationError("--camera: there is no file " + camera.string());
    }
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
