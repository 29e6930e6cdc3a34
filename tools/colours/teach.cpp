#include "tools/colours/teach.h"

#include "core/imaging/colour_table_file.h"
#include "core/imaging/colour_training.h"
#include "core/imaging/file_error.h"
#include "core/process/configuration.h"
#include "tools/goalmouth/output.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <sstream>

namespace goalmouth {

namespace {

namespace fs = std::filesystem;
using Samples = std::array<std::vector<Ycbcr>, colour_count>;

std::string known_classes() {
    std::string names;
    for (const auto name : colour_names) names.append(names.empty() ? "" : ", ").append(name);
    return names;
}

ColourBox read_line(const std::string& text, const fs::path& file, int line) {
    const auto fail = [&](const std::string& what) -> ConfigurationError {
        return ConfigurationError(fmt::format("{}:{}: {}", file.string(), line, what));
    };
    std::istringstream words(text);
    std::string picture, name, rest;
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    if (!(words >> picture >> name >> x0 >> y0 >> x1 >> y1) || words >> rest)
        throw fail("\"" + text +
                   "\" is not PICTURE CLASS X0 Y0 X1 Y1, such as \"1.png goal 507 20 520 180\"");
    const auto found = std::find(colour_names.begin(), colour_names.end(), name);
    if (found == colour_names.end()) throw fail("unknown class \"" + name + "\"; valid: " + known_classes());
    constexpr int largest = 1 << 20;  // px, larger than any picture
    if (x0 < 0 || y0 < 0 || x1 < x0 || y1 < y0 || x1 > largest || y1 > largest)
        throw fail(
            "a box runs from its upper left corner to its lower right one, 0 0 being the picture's first "
            "pixel");
    return {file.parent_path() / picture, static_cast<Colour>(found - colour_names.begin()),
            cv::Rect(cv::Point(x0, y0), cv::Point(x1 + 1, y1 + 1)), line};
}

Samples samples_of(const std::vector<ColourBox>& boxes, const TeachColoursOptions& options) {
    std::map<fs::path, YuyvImage> pictures;
    Samples samples;
    for (const ColourBox& box : boxes) {
        const std::string place = fmt::format("{}:{}: ", options.boxes.string(), box.line);
        auto at = pictures.find(box.picture);
        if (at == pictures.end()) {
            try {
                const auto size = is_raw_image_name(box.picture) ? options.size : std::nullopt;
                at = pictures.emplace(box.picture, read_image(box.picture, size)).first;
            } catch (const FileError& error) {
                throw ConfigurationError(place + error.what());
            }
        }
        const YuyvView image = at->second.view();
        if (box.box.br().x > image.width || box.box.br().y > image.height) {
            throw ConfigurationError(place + fmt::format("the box reaches beyond the picture, which is {}x{}",
                                                         image.width, image.height));
        }
        for (int y = box.box.y; y < box.box.br().y; ++y)
            for (int x = box.box.x; x < box.box.br().x; ++x)
                samples[static_cast<std::size_t>(box.colour)].push_back(image.at(x, y));
    }
    return samples;
}

/// By the class the table gives them.
std::array<double, colour_count> shares(const std::vector<Ycbcr>& samples, const ColourTable& table) {
    std::array<double, colour_count> of_class{};
    for (const Ycbcr p : samples)
        of_class[static_cast<std::size_t>(table.at(p))] += 1.0 / static_cast<double>(samples.size());
    return of_class;
}

/// Classes that were taught the same colours cannot be told apart: one of them would be lost.
void expect_own_colours(const Samples& samples, const ColourTable& table) {
    for (std::size_t c = 0; c < colour_count; ++c) {
        if (samples[c].empty()) continue;
        const auto of_class = shares(samples[c], table);
        const auto most =
            static_cast<std::size_t>(std::max_element(of_class.begin(), of_class.end()) - of_class.begin());
        if (most == c || of_class[c] >= 0.5) continue;
        throw ConfigurationError(
            fmt::format("{} and {} were given the same colours: {:.0f} % of the samples of {} come out as "
                        "{}; the table is not "
                        "written",
                        colour_names[c], colour_names[most], 100.0 * of_class[most], colour_names[c],
                        colour_names[most]));
    }
}

}  // namespace

std::vector<ColourBox> read_colour_boxes(const fs::path& file) {
    std::vector<std::uint8_t> bytes;
    try {
        bytes = read_bytes(file);
    } catch (const FileError& error) {
        throw ConfigurationError(error.what());
    }
    std::istringstream lines(std::string(bytes.begin(), bytes.end()));
    std::vector<ColourBox> boxes;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        line = line.substr(0, line.find('#'));
        if (line.find_first_not_of(" \t\r") != std::string::npos)
            boxes.push_back(read_line(line, file, number));
    }
    if (boxes.empty())
        throw ConfigurationError(file.string() + ": holds no box; a line is PICTURE CLASS X0 Y0 X1 Y1");
    return boxes;
}

int teach_colours(const TeachColoursOptions& options) {
    expect_writable(options.output, "--output");
    const std::vector<ColourBox> boxes = read_colour_boxes(options.boxes);
    const Samples samples = samples_of(boxes, options);
    ColourTrainer trainer;
    for (std::size_t c = 0; c < colour_count; ++c)
        for (const Ycbcr p : samples[c]) trainer.add(p, static_cast<Colour>(c));
    if (!trainer.has_class()) {
        throw ConfigurationError(options.boxes.string() +
                                 ": all boxes are unclassified; a table needs one of a class at least");
    }
    ColourTable table =
        trainer.table(options.bits, options.name.empty() ? options.output.stem().string() : options.name);
    expect_own_colours(samples, table);
    table.add_provenance(
        fmt::format("taught by the {} boxes of {}", boxes.size(), options.boxes.filename().string()));
    save_colour_table(table, options.output);

    fmt::print("{}: {}\n{:<14} {:>9} {:>10}\n", options.output.string(), table.provenance().front(), "class",
               "pixels", "come back");
    for (std::size_t c = 0; c < colour_count; ++c) {
        if (samples[c].empty()) continue;
        fmt::print("{:<14} {:>9} {:>8.1f} %\n", colour_names[c], samples[c].size(),
                   100.0 * shares(samples[c], table)[c]);
    }
    return 0;
}

}  // namespace goalmouth
