#include "tools/evaluate/report/figure.h"

#include "core/imaging/file_error.h"
#include "core/imaging/image_file.h"
#include "core/process/configuration.h"
#include "tools/evaluate/report/figure_script.h"
#include "tools/evaluate/report/figure_svg.h"
#include "tools/evaluate/report/gnuplot.h"
#include "tools/goalmouth/output.h"
#include "tools/goalmouth/temporary_folder.h"

#include <cctype>
#include <stdexcept>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file) {
    try {
        const std::vector<std::uint8_t> bytes = read_bytes(file);
        return {bytes.begin(), bytes.end()};
    } catch (const FileError& error) {
        throw ConfigurationError(std::string("gnuplot wrote no figure: ") + error.what());
    }
}

void check_stem(const std::string& stem) {
    const auto allowed = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
    };
    bool good = !stem.empty();
    for (const char c : stem) good = good && allowed(c);
    if (!good) throw std::invalid_argument("a figure's stem '" + stem + "'");
}

}  // namespace

DrawnFigure draw_figure(const Figure& figure, const fs::path& folder, const std::string& stem) {
    check_stem(stem);
    const std::string script = figure_script(figure);
    const TemporaryFolder bench(folder, ".figure-");
    run_gnuplot(script, bench.path());

    DrawnFigure drawn;
    drawn.svg = folder / (stem + ".svg");
    drawn.png = folder / (stem + ".png");
    drawn.title = figure.title.empty() ? stem : figure.title;
    const std::string svg = read_text(bench.path() / figure_svg_name);
    const std::string png = read_text(bench.path() / figure_png_name);
    drawn.inline_svg = inline_svg(svg, drawn.title, stem);
    write_text(drawn.svg, standalone_svg(svg, drawn.title), "");
    write_text(drawn.png, png, "");
    return drawn;
}

}  // namespace goalmouth
