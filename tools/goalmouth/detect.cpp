#include "core/imaging/conversion.h"
#include "core/imaging/file_error.h"
#include "core/imaging/image_file.h"
#include "core/process/configuration.h"
#include "tools/goalmouth/checks.h"
#include "tools/goalmouth/detect_report.h"
#include "tools/goalmouth/image_chain.h"
#include "tools/goalmouth/output.h"
#include "tools/goalmouth/overlay.h"
#include "tools/goalmouth/picture_files.h"
#include "tools/goalmouth/verbs.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <set>
#include <string>
#include <unistd.h>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

struct Options {
    ImageChainOptions chain;
    std::string json;
    fs::path overlay;
    std::string size;
    double roll = 0.0;
    double pitch = 0.0;
    double height = 0.0;  // 0: not given
    std::vector<std::string> images;
};

/// Writes each picture under a name of its own.
class OverlayFolder {
  public:
    explicit OverlayFolder(fs::path folder) : folder_(std::move(folder)) {
        if (!folder_.empty()) make_output_folder(folder_, "--overlay");
    }

    void write(const std::string& file, YuyvView image, const ImageResult& result) {
        if (folder_.empty()) return;
        cv::Mat picture = bgr_from_yuyv(image);
        draw_candidates(picture, result.candidates);
        draw_border(picture, result.border);
        draw_posts(picture, result.posts);
        const std::string stem = fs::path(file).stem().string();
        std::string name = stem;
        for (int n = 2; !used_.insert(name).second; ++n) name = stem + "_" + std::to_string(n);
        write_picture(folder_ / (name + ".png"), picture, "--overlay");
    }

  private:
    fs::path folder_;
    std::set<std::string> used_;
};

/// "12/345" on a terminal, nothing elsewhere.
class Progress {
  public:
    explicit Progress(std::size_t count) : count_(count), shown_(count > 10 && isatty(STDERR_FILENO) != 0) {}
    ~Progress() {
        if (shown_) std::cerr << "\r\x1b[K" << std::flush;
    }
    void step() {
        if (shown_) std::cerr << '\r' << ++done_ << '/' << count_ << " pictures" << std::flush;
    }

  private:
    std::size_t count_;
    std::size_t done_ = 0;
    bool shown_;
};

/// An array, one picture a line.
void write_json(const std::string& target, const std::vector<nlohmann::ordered_json>& reports) {
    std::string text = "[";
    for (const auto& report : reports) text += (text.size() > 1 ? ",\n " : "\n ") + report.dump();
    text += "\n]\n";
    if (target == "-") {
        std::cout << text;
    } else {
        write_text(target, text, "--json");
    }
}

int detect(Options options) {
    std::optional<ImageSize> size;
    if (!options.size.empty()) {
        size = parse_image_size(options.size);
        if (!size) throw ConfigurationError("--size: \"" + options.size + "\" is no size such as 640x480");
    }
    if (options.height > 0.0)
        options.chain.T_BC = camera_in_body(options.height, options.roll, options.pitch);

    const std::vector<std::string> files = picture_files(options.images);
    if (!options.json.empty() && options.json != "-") expect_writable(options.json, "--json");
    ImageChain chain(options.chain);
    OverlayFolder overlays(options.overlay);
    std::vector<nlohmann::ordered_json> reports;
    std::string summaries;
    int unreadable = 0;
    {
        Progress progress(files.size());
        for (const auto& file : files) {
            progress.step();
            YuyvImage image;
            try {
                image = read_image(file, is_raw_image_name(file) ? size : std::nullopt);
            } catch (const FileError& error) {
                std::cerr << "goalmouth: " << error.what() << '\n';
                ++unreadable;
                continue;
            }
            const ImageResult result = chain.run({.image = image.view(), .camera = {}});
            overlays.write(file, image.view(), result);
            if (!options.json.empty()) reports.push_back(image_report(file, result));
            summaries += image_summary(file, result);
        }
    }
    if (options.json != "-") std::cout << summaries;
    if (!options.json.empty()) write_json(options.json, reports);
    return unreadable > 0 ? 2 : 0;
}

}  // namespace

void add_detect_verb(CLI::App& app, Action& action) {
    auto options = std::make_shared<Options>();
    CLI::App* verb = app.add_subcommand(
        "detect", "Find goalposts in pictures, with the modules of a graph in one process");
    verb->add_option("IMAGE", options->images,
                     "pictures (PNG, JPEG, PPM, raw 4:2:2 as .yuyv) or folders of them")
        ->required();
    verb->add_option("--graph", options->chain.graph,
                     "graph whose stages are used: a file, or the name of one in config/graphs")
        ->capture_default_str();
    verb->add_option("--camera", options->chain.camera,
                     "calibration, scaled to each picture's size; else the graph's");
    verb->add_option("--field", options->chain.field, "field description; else the graph's");
    verb->add_option("--colours", options->chain.colours, "colour table; else the graph's");
    verb->add_flag_callback(
        "--no-refine", [options] { options->chain.refine = false; },
        "posts as the graph's detector measures them, though the graph measures them anew in the pixels");
    verb->add_option("--json", options->json,
                     "write the results there; - for standard output instead of the text");
    verb->add_option("--overlay", options->overlay,
                     "folder for pictures with border, candidates and posts drawn in");
    verb->add_option("--size", options->size, "WIDTHxHEIGHT of raw pictures [px]");
    CLI::Option* height = verb->add_option("--height", options->height, "camera above the ground [m]")
                              ->check(positive_number());
    verb->add_option("--roll", options->roll, "camera roll, clockwise as the camera sees it [rad]")
        ->check(any_number())
        ->needs(height);
    verb->add_option("--pitch", options->pitch, "camera pitch, + down [rad]")
        ->check(any_number())
        ->needs(height);
    verb->add_option("--set", options->chain.settings, "PROCESS.KEY=VALUE: a parameter of one stage")
        ->allow_extra_args(false);
    verb->footer(
        "Exit code: 0 all went well, 2 the command line, the graph or one of its files is wrong, or a "
        "picture "
        "cannot be read\n(the others are processed all the same).");
    verb->callback([options, &action] { action = [options] { return detect(*options); }; });
}

}  // namespace goalmouth
