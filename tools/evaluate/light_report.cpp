#include "core/process/configuration.h"
#include "tools/evaluate/light.h"
#include "tools/evaluate/report/figure.h"
#include "tools/evaluate/report/html_page.h"
#include "tools/evaluate/report/report_folder.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>

namespace goalmouth {
namespace {

/// Both ways of every detector over the lights that `takes` picks.
Figure figure_over(const LightResult& result, const std::string& x_label,
                   const std::function<bool(const LightPlace&)>& takes,
                   const std::function<double(const LightPlace&)>& x_of) {
    Figure figure;
    figure.title = "scene " + result.scene;
    figure.x_label = x_label;
    figure.y_label = "posts found [%]";
    figure.y_range = {0.0, 100.0};
    figure.width = 560;
    figure.height = 400;
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < result.lights.size(); ++i)
        if (takes(result.lights[i])) order.push_back(i);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return x_of(result.lights[a]) < x_of(result.lights[b]); });
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        for (const bool adapting : {true, false}) {
            Series series;
            series.name = result.detectors[d] + (adapting ? ", adapting" : ", without");
            series.style.colour = static_cast<int>(d);
            series.style.dashed = series.style.hollow = !adapting;
            for (const std::size_t i : order) {
                const auto share = result.share(d, i, adapting);
                if (!share) continue;
                series.x.push_back(x_of(result.lights[i]));
                series.y.push_back(100.0 * share->found_share());
            }
            figure.series.push_back(series);
        }
    }
    for (const std::size_t i : order)
        figure.x_ticks.push_back({x_of(result.lights[i]), fmt::format("{:g}", x_of(result.lights[i]))});
    return figure;
}

Table table_of(const LightResult& result) {
    Table table;
    table.columns = {"light",    "detector", "posts",    "adapting", "without",
                     "adapting", "without",  "adapting", "without"};
    table.groups = {{"", 3},
                    {"posts found [%]", 2},
                    {"of those found in the scene's own light [%]", 2},
                    {"false posts a frame", 2}};
    for (std::size_t i = 0; i < result.lights.size(); ++i) {
        for (std::size_t d = 0; d < result.detectors.size(); ++d) {
            const auto on = result.share(d, i, true);
            const auto off = result.share(d, i, false);
            if (!on || !off) continue;
            const auto mark = on->found_share() >= wanted_in_any_light ? Cell::Mark::good : Cell::Mark::bad;
            table.rows.push_back({light_text(result.lights[i]),
                                  result.detectors[d],
                                  {static_cast<double>(on->posts), 0},
                                  {100.0 * on->found_share(), 1, mark},
                                  {100.0 * off->found_share(), 1},
                                  {100.0 * on->kept_share(), 1},
                                  {100.0 * off->kept_share(), 1},
                                  {on->false_per_frame(), 2},
                                  {off->false_per_frame(), 2}});
        }
    }
    table.good = fmt::format("{:g} % or more", 100.0 * wanted_in_any_light);
    table.bad = "less";
    return table;
}

}  // namespace

void write_light_report(const LightResult& result, const std::filesystem::path& target) {
    ReportFolder folder(target);
    HtmlPage page(
        "Goalposts in other light",
        "Rendered frames whose light changes slowly from that of the scene, and what is found in them "
        "by a colour table that follows it and by one that does not.");
    if (!result.complete()) page.note("Not the whole: it was interrupted.");
    page.section("Summary");
    for (std::size_t d = 0; d < result.detectors.size(); ++d) page.paragraph(light_headline(result, d));
    const LightPlace own = result.lights.front();
    Figure brightness = figure_over(
        result, fmt::format("light, × the scene's own, at {:g} K", own.temperature),
        [&](const LightPlace& light) { return light.temperature == own.temperature; },
        [](const LightPlace& light) { return light.brightness; });
    brightness.log_x = true;
    const Figure temperature = figure_over(
        result, "colour temperature [K], light ×1",
        [&](const LightPlace& light) { return light.brightness == own.brightness; },
        [](const LightPlace& light) { return light.temperature; });
    page.figures({draw_figure(brightness, folder.path(), "brightness"),
                  draw_figure(temperature, folder.path(), "temperature")},
                 "Posts found by brightness and by colour temperature.");
    page.section("Each light");
    page.table(table_of(result));
    page.section("How it was made");
    page.code(result.command);
    page.paragraph(fmt::format(
        "Each light has a sequence of frames {:g} s apart: {} in the scene's own light, {} while it changes, "
        "{} in the new light, then those that are judged, the same views of the same halls in every light. "
        "Light is multiplied before noise and clipping; colours are those of black bodies with green kept.",
        light_frame_interval, frames_before, frames_of_change, frames_of_settling));
    page.definitions({{"goalmouth", result.version}, {"seed", std::to_string(result.options.paper.seed)}});
    page.details("Every setting", [&](HtmlPage& inside) { inside.code(result.settings.dump(1)); });
    folder.write("index.html", page.html());
    folder.publish();
}

}  // namespace goalmouth
