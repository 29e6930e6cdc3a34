#include "core/imaging/image_file.h"
#include "core/process/configuration.h"
#include "tools/goalmouth/image_chain.h"
#include "tools/goalmouth/output.h"
#include "tools/goalmouth/overlay.h"
#include "tools/goalmouth/verbs.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <opencv2/imgproc.hpp>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::string image;
    std::vector<std::string> ways;
    std::string camera;
    std::string field;
    fs::path output;
    int width = 640;
};

/// "CAPTION=GRAPH" or "CAPTION=GRAPH,TABLE".
struct Way {
    std::string caption;
    ImageChainOptions chain;
};

Way way_of(const std::string& text, const Options& options) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw ConfigurationError("--way: \"" + text + "\" is not CAPTION=GRAPH or CAPTION=GRAPH,TABLE");
    const auto comma = text.find(',', equals);
    Way way;
    way.caption = text.substr(0, equals);
    way.chain.graph = text.substr(equals + 1, comma == std::string::npos ? comma : comma - equals - 1);
    if (comma != std::string::npos) way.chain.colours = text.substr(comma + 1);
    way.chain.camera = options.camera;
    way.chain.field = options.field;
    return way;
}

/// Nothing of the picture itself: segments on a dark ground, border, posts, and the caption above them.
cv::Mat panel(const std::string& caption, const ImageResult& result, int width) {
    constexpr int head = 28;  // px
    cv::Mat found(result.camera.height, result.camera.width, CV_8UC3);
    draw_segments(found, result.segments);
    draw_border(found, result.border);
    draw_posts(found, result.posts);
    const double as_wide = static_cast<double>(width) / std::max(1, result.camera.width);
    const int height = std::max(1, static_cast<int>(std::min(1e6, result.camera.height * as_wide)));
    constexpr int highest = 16384;  // px
    if (height > highest)
        throw ConfigurationError("--width: that makes the picture " + std::to_string(height) +
                                 " px high; at most " + std::to_string(highest));
    cv::Mat panel(head + height, width, CV_8UC3, cv::Scalar(255, 255, 255));
    cv::resize(found, panel.rowRange(head, head + height), {width, height}, 0.0, 0.0, cv::INTER_AREA);
    cv::putText(panel, caption, {2, head - 9}, cv::FONT_HERSHEY_SIMPLEX, 0.5, {30, 30, 30}, 1, cv::LINE_AA);
    return panel;
}

int compare(const Options& options) {
    expect_writable(options.output, "-o");
    const YuyvImage image = read_image(options.image);
    constexpr int gap = 6;  // px
    std::vector<cv::Mat> panels;
    for (const std::string& text : options.ways) {
        const Way way = way_of(text, options);
        ImageChain chain(way.chain);
        panels.push_back(panel(way.caption, chain.run({.image = image.view(), .camera = {}}), options.width));
    }
    const int count = static_cast<int>(panels.size());
    cv::Mat picture(panels.front().rows, count * (options.width + gap) - gap, CV_8UC3,
                    cv::Scalar(255, 255, 255));
    for (int i = 0; i < count; ++i)
        panels[static_cast<std::size_t>(i)].copyTo(
            picture(cv::Rect(i * (options.width + gap), 0, options.width, picture.rows)));
    write_picture(options.output, picture, "-o");
    return 0;
}

}  // namespace

void add_compare_verb(CLI::App& app, Action& action) {
    const auto options = std::make_shared<Options>();
    CLI::App* verb = app.add_subcommand(
        "compare", "What several graphs make of one picture, side by side, without the picture itself");
    verb->add_option("IMAGE", options->image, "a picture (PNG, JPEG, PPM)")->required();
    verb->add_option("--way", options->ways,
                     "CAPTION=GRAPH or CAPTION=GRAPH,TABLE: a graph of config/graphs or a file, and a colour "
                     "table in place of its own; once for each panel")
        ->required()
        ->allow_extra_args(false);
    verb->add_option("-o,--output", options->output, "the picture to write")->required();
    verb->add_option("--camera", options->camera, "calibration, scaled to the picture; else each graph's");
    verb->add_option("--field", options->field, "field description; else each graph's");
    verb->add_option("--width", options->width, "of each panel [px]")
        ->check(CLI::Range(64, 4096).description(""))
        ->capture_default_str();
    verb->footer(
        "Drawn are the segments in their classes' colours, the field's border and the posts.\n\n"
        "Example:\n"
        "  goalmouth compare frame.png --way 'a table=upright,venue.gmct' --way 'edges=edges' -o both.png\n\n"
        "Exit code: 0 all went well, 2 the command line, a graph or one of its files, or the picture is "
        "wrong.");
    verb->callback([options, &action] { action = [options] { return compare(*options); }; });
}

}  // namespace goalmouth
