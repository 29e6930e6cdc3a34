#include "core/evaluation/cell.h"
#include "tools/evaluate/paper_acceptance.h"
#include "tools/evaluate/paper_facts.h"
#include "tools/evaluate/paper_json_names.h"
#include "tools/evaluate/paper_result.h"
#include "tools/evaluate/paper_rule.h"
#include "tools/evaluate/paper_settings.h"
#include "tools/evaluate/paper_summary.h"
#include "tools/evaluate/shard.h"

namespace goalmouth {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

constexpr double cm = 100.0;  // in a metre

void put_distance(Json& j, const std::optional<ErrorStatistics>& distance) {
    const auto put = [&](const char* name, double ErrorStatistics::*value) {
        j[name] = distance ? Json(cm * (*distance).*value) : Json(nullptr);
    };
    put("rmse_cm", &ErrorStatistics::rmse);
    put("bias_cm", &ErrorStatistics::bias);
    put("sigma_cm", &ErrorStatistics::sigma);
    put("median_abs_cm", &ErrorStatistics::median_abs);
    put("p95_abs_cm", &ErrorStatistics::p95_abs);
}

void put_summary(Json& j, const Summary& summary, bool refines) {
    j["frames"] = summary.frames;
    j["posts"] = summary.posts;
    j["detected"] = summary.detected;
    j["identified"] = summary.identified;
    j["false_posts"] = summary.false_posts;
    put_distance(j, summary.in_line.distance);
    j["in_line_posts"] = summary.in_line.posts;
    j["in_line_detected"] = summary.in_line.detected;
    j["in_line_identified"] = summary.in_line.identified;
    j["measured"] = summary.in_line.measured;
    j["edge_offset_px"] = or_null(summary.in_line.edges);
    j["bearing_rmse_rad"] = or_null(summary.in_line.bearing_rmse);
    Json second;
    second["posts"] = summary.second.posts;
    second["detected"] = summary.second.detected;
    second["identified"] = summary.second.identified;
    second["measured"] = summary.second.measured;
    put_distance(second, summary.second.distance);
    j["second_post"] = second;

    const PostSummary& in_line = summary.in_line;
    j["bound_cm"] = in_line.bound ? Json(cm * *in_line.bound) : Json(nullptr);
    j["rmse_to_bound"] = or_null(in_line.rmse_to_bound());
    j["median_to_bound"] = or_null(in_line.median_to_bound());
    j["both_edges"] = in_line.both_edges;
    j["both_edges_identified"] = in_line.both_edges_identified;
    // What only a chain that refines says.
    j["good"] = refines ? Json(in_line.good) : Json(nullptr);
    j["normalised_error"] = or_null(in_line.normalised_error);
    Json all;
    all["measured"] = in_line.all_measured;
    put_distance(all, in_line.all);
    j["all_measured"] = all;
}

Json heading(const PaperResult& result, std::size_t detector, std::size_t scene) {
    Json j;
    j["detector"] = result.detectors[detector];
    j["scene"] = result.scenes[scene];
    j["size"] = result.options.size;
    return j;
}

std::vector<Json> cells_of(const PaperResult& result, const RecordTable& table) {
    std::vector<Json> cells;
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        for (std::size_t s = 0; s < result.scenes.size(); ++s) {
            for (int c = 0; c < cell_count; ++c) {
                Json j = heading(result, d, s);
                j["distance_cm"] = evaluation_cell(c).distance_cm;
                j["tilt_deg"] = evaluation_cell(c).tilt_deg;
                const Summary cell = table.cell(d, s, c);
                put_summary(j, cell, table.refines(d));
                j["bias_to_bar"] = or_null(bias_to_bar(cell.in_line, evaluation_cell(c)));
                cells.push_back(std::move(j));
            }
        }
    }
    return cells;
}

std::vector<Json> tilts_of(const PaperResult& result, const RecordTable& table) {
    std::vector<Json> tilts;
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        for (std::size_t s = 0; s < result.scenes.size(); ++s) {
            for (std::size_t t = 0; t < cell_tilts_deg.size(); ++t) {
                Json j = heading(result, d, s);
                j["tilt_deg"] = cell_tilts_deg[t];
                put_summary(j, table.tilt(d, s, t), table.refines(d));
                tilts.push_back(std::move(j));
            }
        }
    }
    return tilts;
}

std::vector<Json> acceptance_of(const PaperResult& result, const RecordTable& table) {
    std::vector<Json> lines;
    for (const AcceptanceLine& line : paper_acceptance(result, table)) {
        Json j;
        j["detector"] = line.detector;
        j["scene"] = line.scene;
        j["what"] = line.what;
        j["holds"] = line.holds;
        lines.push_back(std::move(j));
    }
    return lines;
}

int state_of(const PostRecord& post) {
    return (post.counts ? post_state::counts : 0) + (post.found ? post_state::detected : 0) +
           (post.identified ? post_state::identified : 0) + (post.good ? post_state::good : 0) +
           (post.both_edges ? post_state::both_edges : 0);
}

std::vector<Json> rows_of(const PaperResult& result) {
    std::vector<Json> rows;
    for (const FrameRecord& frame : result.records) {
        for (std::size_t d = 0; d < frame.detectors.size(); ++d) {
            const DetectorRecord& r = frame.detectors[d];
            const auto edge = [&](std::size_t side) {
                return r.in_line.edges ? Json((*r.in_line.edges)[side]) : Json(nullptr);
            };
            rows.push_back(Json::array(
                {frame.place.scene, frame.place.cell, frame.place.index, d, r.posts, r.detected, r.identified,
                 r.false_posts, state_of(r.in_line), or_null(r.in_line.distance_error), edge(0), edge(1),
                 or_null(r.in_line.bearing_error), state_of(r.second), or_null(r.second.distance_error),
                 or_null(r.in_line.bound), or_null(r.in_line.normalised_error)}));
        }
    }
    return rows;
}

Json options_of(const PaperOptions& options) {
    Json j;
    j["detectors"] = options.detectors;
    j["scene"] = options.scenes;
    j["set"] = options.settings;
    j["field"] = options.field;
    j["camera"] = options.camera;
    j["colours"] = options.colours;
    return j;
}

Json paper_of() {
    Json j;
    j["source"] = paper_source;
    j["frames"] = paper_frames;
    for (const char* detector : {"histogram", "ransac"}) {
        const auto figures = paper_figures(detector);
        Json of;
        for (std::size_t t = 0; t < cell_tilts_deg.size(); ++t)
            of["rmse_cm"][std::to_string(cell_tilts_deg[t])] = or_null(figures->rmse_cm[t]);
        of["detection"] = figures->detection;
        j[detector] = of;
    }
    return j;
}

/// A list with one entry a line.
std::string lines(const std::vector<Json>& entries) {
    std::string text = "[";
    for (const Json& entry : entries) text += (text.size() > 1 ? ",\n  " : "\n  ") + entry.dump();
    return text + "\n ]";
}

}  // namespace

std::string paper_json(const PaperResult& result) {
    std::string text = "{";
    const auto put_text = [&](const std::string& name, const std::string& value) {
        text += (text.size() > 1 ? ",\n \"" : "\n \"") + name + "\": " + value;
    };
    const auto put = [&](const std::string& name, const Json& value) { put_text(name, value.dump()); };
    put("what", paper_what);
    put("version", result.version);
    put("command", result.command);
    put("seed", result.options.seed);
    put("size", result.options.size);
    put("scenes", result.scenes);
    put("detectors", result.detectors);
    put("frames_per_cell", result.options.frames_per_cell);
    put("shard", result.shard ? Json(shard_text(*result.shard)) : Json(nullptr));
    put("complete", result.complete);
    put("field", result.settings.at("field"));
    put("camera", result.settings.at("camera"));
    put("rule", paper_rule());
    put("paper", paper_of());
    const RecordTable table(result.records, result.scenes.size(),
                            refining_detectors(result.settings, result.detectors));
    put_text("cells", lines(cells_of(result, table)));
    put_text("tilts", lines(tilts_of(result, table)));
    put_text("acceptance", lines(acceptance_of(result, table)));
    put("options", options_of(result.options));
    put("settings", result.settings);
    put("frame_columns", frame_columns);
    put_text("frames", lines(rows_of(result)));
    return text + "\n}\n";
}

}  // namespace goalmouth
