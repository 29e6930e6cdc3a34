#include "tests/bench/summary.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace goalmouth::bench {
namespace {

using Json = nlohmann::ordered_json;

const char* kind_name(StageRow::Kind kind) {
    switch (kind) {
        case StageRow::Kind::ours:
            return "ours";
        case StageRow::Kind::part:
            return "part of ours";
        case StageRow::Kind::plain:
            return "our plain version";
        case StageRow::Kind::floor:
            return "floor";
        case StageRow::Kind::other:
            return "other";
    }
    return "";
}

std::string size_name(ImageSize size) {
    return fmt::format("{}x{}", size.width, size.height);
}

void add_timing(Json& json, const Timing& timing) {
    json["median_ms"] = timing.median;
    json["p25_ms"] = timing.p25;
    json["p75_ms"] = timing.p75;
    json["p95_ms"] = timing.p95;
    json["min_ms"] = timing.least;
    json["mean_ms"] = timing.mean;
    json["samples"] = timing.count;
}

Json ratio_json(const Ratio& ratio) {
    const auto value = [&](double number) { return ratio.measured ? Json(number) : Json(nullptr); };
    Json json{{"name", ratio.name},          {"ours_ms", value(ratio.ours_ms)},
              {"other", ratio.other},        {"other_ms", value(ratio.other_ms)},
              {"ratio", value(ratio.ratio)}, {"bar", ratio.bar},
              {"stretch", ratio.stretch}};
    json["measured"] = ratio.measured;
    json["verdict"] = verdict_text(ratio);
    json["size"] = ratio.size.empty() ? Json(nullptr) : Json(ratio.size);
    json["spacing"] = ratio.spacing == 0 ? Json(nullptr) : Json(ratio.spacing);
    if (ratio.seconds > 0.0) json["seconds"] = ratio.seconds;
    if (!ratio.note.empty()) json["note"] = ratio.note;
    if (!ratio.unit.empty()) json["unit"] = ratio.unit;
    json["met"] = ratio.met();
    json["stretch_met"] = ratio.stretch_met();
    return json;
}

Json machine_json(const Machine& machine) {
    return {{"processor", machine.processor},
            {"processors", machine.processors},
            {"last_level_cache_bytes", machine.last_level_cache},
            {"system", machine.system},
            {"simd", machine.simd},
            {"opencv_features", machine.opencv_features}};
}

Json row_json(const SizeResult& size, const StageRow& row) {
    Json json{{"size", size_name(size.size)}};
    json["spacing"] = row.spacing == 0 ? Json(nullptr) : Json(row.spacing);
    json["name"] = row.timing.name;
    json["label"] = row.timing.label;
    json["kind"] = kind_name(row.kind);
    add_timing(json, row.timing);
    if (!row.settings.empty()) json["settings"] = row.settings;
    if (!row.finds.empty()) {
        json["finds"] = row.finds;
        json["found_per_frame"] = row.found;
    }
    if (row.edges_seen) json["post_edges_seen"] = *row.edges_seen;
    return json;
}

Json refinement_json(const SizeResult& size) {
    const RefinementRow& row = *size.refinement;
    Json json{{"size", size_name(size.size)},
              {"posts", row.posts},
              {"refined", row.refined},
              {"compared", row.compared},
              {"disagreement_sigmas", row.compared > 0 ? Json(row.disagreement) : Json(nullptr)}};
    if (!row.measured()) return json;
    Json ours = Json::object();
    Json full = Json::object();
    add_timing(ours, row.ours);
    add_timing(full, row.full);
    json["ratio"] = row.ratio();
    json["ours"] = ours;
    json["full"] = full;
    return json;
}

Json growth_json(const StagesResult& stages) {
    Json by_spacing = Json::array();
    for (const SizeResult& size : stages.sizes) {
        for (const int spacing : spacings) {
            Json json{{"size", size_name(size.size)}, {"spacing", spacing}};
            for (const char* name : {"segments", "edge_segments", "frame_to_posts", "naive_segments"})
                json[fmt::format("{}_ms", name)] = size.median(fmt::format("{}_{}", name, spacing));
            by_spacing.push_back(json);
        }
    }
    Json by_points = Json::array();
    for (const PointRow& row : stages.points)
        by_points.push_back(
            {{"points", row.points}, {"ours_ms", row.ours.median}, {"literal_ms", row.literal.median}});
    return {{"spacing", by_spacing}, {"points", by_points}};
}

void add_stages(Json& json, const StagesResult& stages) {
    json["same_segments"] = stages.same_segments;
    json["left_out"] = stages.left_out;
    json["frames"] = Json::array();
    json["stages"] = Json::array();
    for (const SizeResult& size : stages.sizes) {
        json["frames"].push_back({{"size", size_name(size.size)},
                                  {"frames", size.frames},
                                  {"different", size.different},
                                  {"bytes", size.bytes},
                                  {"true_post_edges", size.true_edges},
                                  {"source", size.source}});
        for (const StageRow& row : size.rows) json["stages"].push_back(row_json(size, row));
    }
    json["points"] = Json::array();
    for (const PointRow& row : stages.points) {
        Json ours = Json::object();
        Json literal = Json::object();
        add_timing(ours, row.ours);
        add_timing(literal, row.literal);
        json["points"].push_back({{"points", row.points},
                                  {"same_consensus", row.same_consensus},
                                  {"ratio", row.ratio()},
                                  {"lines_found", row.lines},
                                  {"ours", ours},
                                  {"literal", literal}});
    }
    json["refinement"] = Json::array();
    for (const SizeResult& size : stages.sizes)
        if (size.refinement) json["refinement"].push_back(refinement_json(size));
    json["growth"] = growth_json(stages);
}

}  // namespace

nlohmann::ordered_json bench_json(const BenchResult& result) {
    Json json{{"command", result.command}, {"seed", result.options.seed}};
    json["machine"] = machine_json(result.machine);
    json["versions"] = Json::object();
    for (const auto& [name, version] : result.machine.versions) json["versions"][name] = version;
    json["versions"]["compiler"] = result.machine.compiler;
    json["ratios"] = Json::array();
    for (const Ratio& ratio : result.ratios()) json["ratios"].push_back(ratio_json(ratio));
    if (result.stages) add_stages(json, *result.stages);
    if (result.graph) json["graph"] = result.graph->to_json();
    return json;
}

}  // namespace goalmouth::bench
