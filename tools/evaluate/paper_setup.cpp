#include "tools/evaluate/paper_setup.h"

#include "core/imaging/calibration.h"
#include "core/imaging/image_file.h"
#include "core/process/configuration.h"
#include "core/process/graph.h"
#include "core/process/paths.h"
#include "core/process/text.h"
#include "core/simulation/exposure.h"
#include "tools/evaluate/file_hash.h"
#include "tools/evaluate/graph_settings.h"
#include "tools/evaluate/paper_settings.h"
#include "tools/goalmouth/image_chain.h"
#include "tools/goalmouth/registry.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

constexpr int smallest_side = 16;  // px
constexpr int largest_side = 8192;

/// The name a scene goes by in a report.
std::string stem(const std::string& name_or_file) {
    return fs::path(name_or_file).stem().string();
}

/// Scenes named in a list, all different by their files' stems.
std::vector<std::string> scene_list(const std::string& text) {
    std::set<std::string> names;
    const std::vector<std::string> scenes = split(text, ',');
    for (const auto& scene : scenes) {
        if (scene.empty() || text.ends_with(','))
            throw ConfigurationError("--scene: \"" + text +
                                     "\" is no list of names with a comma between them");
        if (!names.insert(stem(scene)).second)
            throw ConfigurationError("--scene: '" + stem(scene) + "' is named twice");
    }
    return scenes;
}

fs::path given_or(const std::string& given, const std::string& option, const fs::path& otherwise) {
    if (given.empty()) return config_folder() / otherwise;
    std::error_code ignored;
    if (!fs::is_regular_file(given, ignored))
        throw ConfigurationError(option + ": there is no file " + given);
    return given;
}

void check_scene(const EvaluationScene& scene, const Field& field) {
    try {
        make_scene(field, scene.formation.hall);
        Exposure(scene.formation.exposure, scene.formation.light.temperature, Random(0));
    } catch (const std::invalid_argument& error) {
        throw ConfigurationError("scene " + scene.name + ": " + error.what());
    }
}

}  // namespace

EvaluationScene load_evaluation_scene(const std::string& name_or_file) {
    const fs::path folder = config_folder() / "evaluation";
    std::error_code ignored;
    fs::path file;
    for (const fs::path& each :
         {fs::path(name_or_file), folder / name_or_file, folder / (name_or_file + ".yaml")}) {
        if (!name_or_file.empty() && fs::is_regular_file(each, ignored)) {
            file = each;
            break;
        }
    }
    if (file.empty()) {
        std::vector<std::string> known;
        for (const auto& entry : fs::directory_iterator(folder, ignored))
            if (entry.path().extension() == ".yaml") known.push_back(entry.path().stem().string());
        std::sort(known.begin(), known.end());
        throw ConfigurationError("--scene: no scene '" + name_or_file + "': neither a file nor one in " +
                                 folder.string() + "; " + suggestion(name_or_file, known));
    }
    const Configuration configuration = Configuration::from_file(file);
    EvaluationScene scene;
    scene.name = stem(name_or_file);
    scene.parameters = load_parameters<EvaluationSceneParameters>(configuration);
    const auto& view = scene.parameters.view;
    if (view.pitch_lowest > view.pitch_highest)
        throw ConfigurationError(file.string() + ": view.pitch_lowest is above view.pitch_highest");
    const std::string hall = configuration.file("scene");
    if (hall.empty())
        throw ConfigurationError(file.string() + ": scene: expected a file, such as ../scenes/flat.yaml");
    scene.formation = load_parameters<ImageFormationParameters>(fs::path(hall));
    return scene;
}

Detector chain_detector(const std::string& graph, const std::vector<std::string>& settings,
                        const PaperOptions& options, bool carry_over) {
    ImageChainOptions chain;
    chain.carry_over = carry_over;
    chain.graph = graph;
    chain.settings = settings;
    chain.camera = given_or(options.camera, "--camera", "cameras/c905.yaml");
    chain.field = given_or(options.field, "--field", "fields/kidsize_2013.yaml");
    chain.colours = options.colours;
    chain.seed = options.seed;
    return {graph_name(graph), [chain]() -> DetectPosts {
                const auto stages = std::make_shared<ImageChain>(chain);
                return [stages](const DetectorInput& input) {
                    ChainFrame frame;
                    frame.image = input.image;
                    frame.seq = input.seq;
                    frame.camera = input.told;
                    frame.kinematics = input.kinematics;
                    frame.utime = input.utime;
                    return stages->run(frame).posts;
                };
            }};
}

PaperSetup set_up_paper(const PaperOptions& options) {
    PaperSetup setup;
    PaperGrid& grid = setup.grid;
    const auto size = parse_image_size(options.size);
    if (!size) throw ConfigurationError("--size: \"" + options.size + "\" is no size such as 640x480");
    if (std::min(size->width, size->height) < smallest_side ||
        std::max(size->width, size->height) > largest_side)
        throw ConfigurationError("--size: " + options.size + ": each side must be " +
                                 std::to_string(smallest_side) + "…" + std::to_string(largest_side) + " px");
    const fs::path camera = given_or(options.camera, "--camera", "cameras/c905.yaml");
    const auto calibration = calibration_for(load_parameters<Intrinsics>(camera), size->width, size->height);
    if (!calibration)
        throw ConfigurationError("--size: " + options.size + " has another shape than the pictures that " +
                                 camera.string() + " is the calibration of");
    grid.camera = *calibration;
    grid.field = load_parameters<Field>(given_or(options.field, "--field", "fields/kidsize_2013.yaml"));
    grid.seed = options.seed;
    grid.frames_per_cell = options.frames_per_cell;

    for (const auto& name : scene_list(options.scenes)) {
        grid.scenes.push_back(load_evaluation_scene(name));
        check_scene(grid.scenes.back(), grid.field);
    }

    const std::vector<std::string> graphs = graph_list(options.detectors, "--detectors");
    if (!options.colours.empty()) given_or(options.colours, "--colours", {});
    setup.settings = settings_as_json(grid);
    const auto shares = share_out_settings(options.settings, graphs);
    for (std::size_t i = 0; i < graphs.size(); ++i) {
        const Detector& detector =
            setup.detectors.emplace_back(chain_detector(graphs[i], shares[i], options));
        detector.make();  // says now what is wrong with it
        GraphOptions described;
        described.describe = describe_module;
        described.settings = shares[i];
        setup.settings["detectors"][detector.name] = settings_as_json(load_graph(graphs[i], described));
    }
    if (!options.colours.empty()) {
        setup.settings["colours"] = fs::path(options.colours).filename().string();
        setup.settings[std::string("colours") + hash_suffix] = file_hash(options.colours);
    }
    return setup;
}

}  // namespace goalmouth
