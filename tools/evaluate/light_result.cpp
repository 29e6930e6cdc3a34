#include "tools/evaluate/light_result.h"

#include <algorithm>
#include <fmt/format.h>

namespace goalmouth {
namespace {

using Json = nlohmann::ordered_json;

const LightVerdict& verdict(const LightFrame& frame, std::size_t detector, bool adapting) {
    return (adapting ? frame.adapting : frame.fixed)[detector];
}

/// The light in which fewest posts are found.
std::optional<std::size_t> worst_light(const LightResult& result, std::size_t detector, bool adapting) {
    std::optional<std::size_t> worst;
    double least = 2.0;
    for (std::size_t i = 0; i < result.lights.size(); ++i) {
        const auto share = result.share(detector, i, adapting);
        if (!share || share->found_share() >= least) continue;
        least = share->found_share();
        worst = i;
    }
    return worst;
}

std::string worst_cell(const LightResult& result, std::size_t detector, std::size_t light) {
    std::string text;
    double least = 2.0;
    for (int cell = 0; cell < cell_count; ++cell) {
        const auto share = result.share(detector, light, true, cell);
        if (!share || share->posts == 0 || share->found_share() >= least) continue;
        least = share->found_share();
        const EvaluationCell at = evaluation_cell(cell);
        text = fmt::format("{:.0f} % of {} at {} cm, {}°", 100.0 * least, share->posts, at.distance_cm,
                           at.tilt_deg);
    }
    return text;
}

Json share_as_json(const std::optional<LightShare>& share) {
    if (!share) return nullptr;
    return {{"posts", share->posts},
            {"found", share->found},
            {"found_share", share->found_share()},
            {"false_posts", share->false_posts},
            {"known", share->known},
            {"kept", share->kept},
            {"kept_share", share->kept_share()}};
}

}  // namespace

LightOptions::LightOptions() {
    paper.frames_per_cell = 5;
    paper.detectors = "upright";
    paper.scenes = "match";
}

bool LightResult::complete() const {
    return std::all_of(sequences.begin(), sequences.end(), [](const auto& s) { return s.has_value(); });
}

std::optional<LightShare> LightResult::share(std::size_t detector, std::size_t light, bool adapting,
                                             std::optional<int> cell) const {
    const auto& here = sequences.at(light);
    const auto& own = sequences.front();
    if (!here || !own) return std::nullopt;
    LightShare share;
    for (std::size_t i = 0; i < here->size(); ++i) {
        const LightFrame& frame = (*here)[i];
        if (cell && frame.cell != *cell) continue;
        const LightVerdict& seen = verdict(frame, detector, adapting);
        const LightVerdict& known = verdict((*own)[i], detector, false);
        ++share.frames;
        share.false_posts += seen.false_posts;
        for (std::size_t p = 0; p < seen.found.size(); ++p) {
            ++share.posts;
            share.found += seen.found[p];
            share.known += known.found[p];
            share.kept += known.found[p] && seen.found[p];
        }
    }
    return share;
}

std::string light_headline(const LightResult& result, std::size_t detector) {
    const auto own = result.share(detector, 0, false);
    const auto worst = worst_light(result, detector, true);
    const auto worst_fixed = worst_light(result, detector, false);
    if (!own || !worst) return result.detectors[detector] + ": nothing was measured.";
    const LightShare adapting = *result.share(detector, *worst, true);
    const LightShare fixed = *result.share(detector, *worst, false);
    const LightShare without = *result.share(detector, *worst_fixed, false);
    double least_kept = 2.0;
    std::size_t least_kept_in = 0;
    for (std::size_t i = result.lights.size() > 1 ? 1 : 0; i < result.lights.size(); ++i) {
        const auto share = result.share(detector, i, true);
        if (!share || share->kept_share() >= least_kept) continue;
        least_kept = share->kept_share();
        least_kept_in = i;
    }
    return fmt::format(
        "{}: adapting, {:.1f} % of the posts are found in the worst light ({}), {:.1f} % there without; "
        "without adapting at worst {:.1f} % ({}); in the scene's own light, without, {:.1f} %. Of the posts "
        "found there, {:.1f} % are found in any other light when adapting, at worst ({}). Worst cell of the "
        "worst light: {}. Asked are {:g} % in every light, adapting: {}.",
        result.detectors[detector], 100.0 * adapting.found_share(), light_text(result.lights[*worst]),
        100.0 * fixed.found_share(), 100.0 * without.found_share(), light_text(result.lights[*worst_fixed]),
        100.0 * own->found_share(), 100.0 * least_kept, light_text(result.lights[least_kept_in]),
        worst_cell(result, detector, *worst), 100.0 * wanted_in_any_light,
        adapting.found_share() < wanted_in_any_light ? "does not hold"
        : result.complete()                          ? "holds"
                                                     : "not all lights were run");
}

std::string light_table(const LightResult& result) {
    std::string text = fmt::format(
        "Scene {}, {} frames in each light; kept: of the posts found in the scene's own light ({}) without "
        "adapting\n",
        result.scene, cell_count * result.options.paper.frames_per_cell, light_text(result.lights.front()));
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        text += fmt::format("\n{:<16}{:>6}  {:^23}  {:^23}  {:^23}\n", result.detectors[d], "",
                            "posts found [%]", "kept [%]", "false posts a frame");
        text += fmt::format("{:<16}{:>6}", "light", "posts");
        for (int i = 0; i < 3; ++i) text += fmt::format("  {:>11} {:>11}", "adapting", "without");
        text += '\n';
        for (std::size_t i = 0; i < result.lights.size(); ++i) {
            const auto on = result.share(d, i, true);
            const auto off = result.share(d, i, false);
            // Not by bytes: × has two.
            const std::string name = light_text(result.lights[i]);
            text += name + std::string(name.size() < 17 ? 17 - name.size() : 1, ' ');
            if (on)
                text += fmt::format("{:>6}  {:>11.1f} {:>11.1f}  {:>11.1f} {:>11.1f}  {:>11.2f} {:>11.2f}",
                                    on->posts, 100.0 * on->found_share(), 100.0 * off->found_share(),
                                    100.0 * on->kept_share(), 100.0 * off->kept_share(),
                                    on->false_per_frame(), off->false_per_frame());
            else
                text += "  not run to its end";
            text += '\n';
        }
        text += light_headline(result, d) + '\n';
    }
    return text;
}

std::string light_json(const LightResult& result) {
    Json lights = Json::array();
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        for (std::size_t i = 0; i < result.lights.size(); ++i) {
            Json cells = Json::array();
            for (int cell = 0; cell < cell_count; ++cell)
                cells.push_back({{"distance_cm", evaluation_cell(cell).distance_cm},
                                 {"tilt_deg", evaluation_cell(cell).tilt_deg},
                                 {"adapting", share_as_json(result.share(d, i, true, cell))},
                                 {"fixed", share_as_json(result.share(d, i, false, cell))}});
            lights.push_back({{"detector", result.detectors[d]},
                              {"brightness", result.lights[i].brightness},
                              {"temperature_k", result.lights[i].temperature},
                              {"adapting", share_as_json(result.share(d, i, true))},
                              {"fixed", share_as_json(result.share(d, i, false))},
                              {"cells", cells}});
        }
    }
    Json headlines = Json::array();
    for (std::size_t d = 0; d < result.detectors.size(); ++d) headlines.push_back(light_headline(result, d));
    const Json json = {{"what", "light"},
                       {"version", result.version},
                       {"command", result.command},
                       {"complete", result.complete()},
                       {"scene", result.scene},
                       {"seed", result.options.paper.seed},
                       {"size", result.options.paper.size},
                       {"frames_per_light", cell_count * result.options.paper.frames_per_cell},
                       {"headlines", headlines},
                       {"lights", lights},
                       {"settings", result.settings}};
    return json.dump(1) + "\n";
}

}  // namespace goalmouth
