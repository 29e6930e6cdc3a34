#include "tools/evaluate/localisation_data.h"

#include "core/imaging/file_error.h"
#include "core/imaging/image_file.h"
#include "core/process/configuration.h"
#include "tools/evaluate/localisation.h"
#include "tools/evaluate/localisation_summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace goalmouth {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json quality_json(const PoseQuality& q) {
    return {{"position_error_m", q.position_error},
            {"heading_error_rad", q.heading_error},
            {"position_sigma_m", q.position_sigma},
            {"heading_sigma_rad", q.heading_sigma}};
}

PoseQuality quality_from(const json& j) {
    return {j.at("position_error_m").get<double>(), j.at("heading_error_rad").get<double>(),
            j.at("position_sigma_m").get<double>(), j.at("heading_sigma_rad").get<double>()};
}

ordered_json pose_json(const Pose2& p) {
    return {p.x, p.y, p.theta};
}

Pose2 pose_from(const json& j) {
    return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

ordered_json run_json(const LocalisationRun& run, const std::vector<std::string>& names) {
    ordered_json j = {{"run", run.run}, {"frames", run.frames}, {"times", run.times}};
    j["truth"] = ordered_json::array();
    for (const Pose2& pose : run.truth) j["truth"].push_back(pose_json(pose));
    j["detectors"] = ordered_json::array();
    for (std::size_t d = 0; d < names.size(); ++d) {
        const DetectorWalk& walk = run.detectors[d];
        ordered_json one = {{"detector", names[d]},
                            {"walk", quality_json(walk.walk)},
                            {"end", quality_json(walk.end)},
                            {"posts", walk.posts}};
        one["path"] = ordered_json::array();
        for (const Pose2& pose : walk.path) one["path"].push_back(pose_json(pose));
        one["track"] = ordered_json::array();
        for (const PoseQuality& q : walk.track) {
            one["track"].push_back({q.position_error, q.heading_error, q.position_sigma, q.heading_sigma});
        }
        j["detectors"].push_back(std::move(one));
    }
    return j;
}

LocalisationRun run_from(const json& j, const std::vector<std::string>& names) {
    LocalisationRun run;
    run.run = j.at("run").get<int>();
    run.frames = j.at("frames").get<int>();
    run.times = j.at("times").get<std::vector<double>>();
    for (const json& pose : j.at("truth")) run.truth.push_back(pose_from(pose));
    for (std::size_t d = 0; d < names.size(); ++d) {
        const json& one = j.at("detectors").at(d);
        if (one.at("detector") != names[d])
            throw ConfigurationError("run " + std::to_string(run.run) + " has other detectors");
        DetectorWalk walk;
        walk.walk = quality_from(one.at("walk"));
        walk.end = quality_from(one.at("end"));
        walk.posts = one.at("posts").get<int>();
        for (const json& pose : one.at("path")) walk.path.push_back(pose_from(pose));
        for (const json& q : one.at("track")) {
            walk.track.push_back(
                {q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>(), q.at(3).get<double>()});
        }
        if (run.truth.size() != run.times.size() || walk.path.size() != run.times.size() ||
            walk.track.size() != run.times.size())
            throw ConfigurationError("run " + std::to_string(run.run) + " has samples without a time");
        run.detectors.push_back(std::move(walk));
    }
    return run;
}

ordered_json mean_json(const MeanSigma& m) {
    return {{"mean", m.mean}, {"sigma", m.sigma}};
}

ordered_json summary_json(const QualitySummary& s) {
    return {
        {"position_error_m", mean_json(s.position_error)}, {"heading_error_rad", mean_json(s.heading_error)},
        {"position_sigma_m", mean_json(s.position_sigma)}, {"heading_sigma_rad", mean_json(s.heading_sigma)},
        {"position_error_median_m", s.position_median},    {"heading_error_median_rad", s.heading_median}};
}

ordered_json reduction_json(const Reduction& r) {
    return {{"reduction", r.value}, {"low95", r.low}, {"high95", r.high}};
}

ordered_json comparison_json(const DetectorComparison& c) {
    return {{"detector", c.detector},
            {"against", c.against},
            {"walk",
             {{"position_error", reduction_json(c.walk_position_error)},
              {"heading_error", reduction_json(c.walk_heading_error)},
              {"position_sigma", reduction_json(c.walk_position_sigma)},
              {"heading_sigma", reduction_json(c.walk_heading_sigma)}}},
            {"end",
             {{"position_error", reduction_json(c.end_position_error)},
              {"heading_error", reduction_json(c.end_heading_error)},
              {"position_sigma", reduction_json(c.end_position_sigma)},
              {"heading_sigma", reduction_json(c.end_heading_sigma)}}}};
}

ordered_json paper_json() {
    const PaperLocalisation paper;
    return {{"histogram",
             {{"position_m", mean_json(paper.histogram_position)},
              {"heading_rad", mean_json(paper.histogram_heading)}}},
            {"ransac",
             {{"position_m", mean_json(paper.ransac_position)},
              {"heading_rad", mean_json(paper.ransac_heading)}}},
            {"position_reduction", paper.position_reduction},
            {"heading_reduction", paper.heading_reduction},
            {"heading_reduction_stated", paper.heading_reduction_stated}};
}

/// A sentence about what differs between two parts of what should be one evaluation; "" where nothing does.
std::string difference(const LocalisationResult& a, const LocalisationResult& b) {
    if (a.seed != b.seed) return "their seeds differ";
    if (a.runs != b.runs) return "their numbers of runs differ";
    if (a.detectors != b.detectors) return "their detectors differ";
    if (a.seconds != b.seconds || a.frames_per_second != b.frames_per_second)
        return "their lengths or frame rates differ";
    if (a.scene != b.scene) return "their scenes differ";
    if (a.settings != b.settings) return "their settings differ";
    if (a.version != b.version) return "they were made by different versions of goalmouth";
    return {};
}

}  // namespace

double rounded(double value) {
    return std::round(value * 1e4) / 1e4;
}

bool LocalisationResult::complete() const {
    return static_cast<int>(done.size()) == runs;
}

ordered_json localisation_json(const LocalisationResult& result) {
    ordered_json j;
    j["what"] = localisation_what;
    j["version"] = result.version;
    j["command"] = result.command;
    j["seed"] = result.seed;
    j["runs"] = result.runs;
    j["runs_done"] = result.done.size();
    if (!result.shard.empty()) j["shard"] = result.shard;
    j["detectors"] = result.detectors;
    j["scene"] = result.scene;
    j["seconds"] = result.seconds;
    j["frames_per_second"] = result.frames_per_second;
    j["end_seconds"] = 1.0;
    j["lost_beyond_m"] = lost_beyond;
    j["summaries"] = ordered_json::array();
    for (const DetectorSummary& s : summarise(result)) {
        j["summaries"].push_back({{"detector", s.detector},
                                  {"runs", s.runs},
                                  {"walk", summary_json(s.walk)},
                                  {"end", summary_json(s.end)},
                                  {"lost", s.lost},
                                  {"posts_per_frame", s.posts_per_frame}});
    }
    j["comparisons"] = ordered_json::array();
    for (const DetectorComparison& c : compare(result)) j["comparisons"].push_back(comparison_json(c));
    j["paper"] = paper_json();
    j["settings"] = result.settings;
    j["results"] = ordered_json::array();
    for (const LocalisationRun& run : result.done) j["results"].push_back(run_json(run, result.detectors));
    return j;
}

LocalisationResult read_localisation_json(const json& document, const std::filesystem::path& file) {
    LocalisationResult result;
    try {
        if (!document.is_object() || document.value("what", json()) != json(localisation_what))
            throw ConfigurationError("the result of another program");
        result.version = document.at("version").get<std::string>();
        result.command = document.at("command").get<std::string>();
        result.seed = document.at("seed").get<std::uint64_t>();
        result.runs = document.at("runs").get<int>();
        result.shard = document.value("shard", "");
        result.detectors = document.at("detectors").get<std::vector<std::string>>();
        result.scene = document.at("scene").get<std::string>();
        result.seconds = document.at("seconds").get<double>();
        result.frames_per_second = document.at("frames_per_second").get<double>();
        result.settings = document.at("settings");
        result.field = load_parameters<Field>(
            Configuration::from_text(result.settings.at("field").dump(), file.string()));
        for (const json& run : document.at("results")) result.done.push_back(run_from(run, result.detectors));
    } catch (const json::exception& error) {
        throw ConfigurationError(file.string() +
                                 ": not a result of `goalmouth evaluate localisation`: " + error.what());
    } catch (const ConfigurationError& error) {
        throw ConfigurationError(file.string() +
                                 ": not a result of `goalmouth evaluate localisation`: " + error.what());
    }
    return result;
}

LocalisationResult join_localisation(const std::vector<std::filesystem::path>& files) {
    std::optional<LocalisationResult> whole;
    std::map<int, std::filesystem::path> seen;  // run → file
    for (const std::filesystem::path& file : files) {
        json document;
        try {
            const std::vector<std::uint8_t> bytes = read_bytes(file);
            document = json::parse(bytes.begin(), bytes.end());
        } catch (const FileError& error) {
            throw ConfigurationError(error.what());
        } catch (const json::exception& error) {
            throw ConfigurationError(file.string() + ": not JSON: " + error.what());
        }
        LocalisationResult part = read_localisation_json(document, file);
        for (const LocalisationRun& run : part.done) {
            const auto [known, fresh] = seen.emplace(run.run, file);
            if (!fresh) {
                throw ConfigurationError(file.string() + ": holds run " + std::to_string(run.run) +
                                         ", and so does " + known->second.string());
            }
        }
        if (!whole) {
            whole = std::move(part);
            continue;
        }
        if (const std::string problem = difference(*whole, part); !problem.empty()) {
            throw ConfigurationError(file.string() + " and " + files.front().string() +
                                     " are not parts of one evaluation: " + problem);
        }
        std::move(part.done.begin(), part.done.end(), std::back_inserter(whole->done));
    }
    if (!whole) throw ConfigurationError("there is nothing to merge");
    whole->shard.clear();
    whole->command = whole->command.substr(0, whole->command.find(" --shard "));
    std::sort(whole->done.begin(), whole->done.end(),
              [](const LocalisationRun& a, const LocalisationRun& b) { return a.run < b.run; });
    return std::move(*whole);
}

}  // namespace goalmouth
