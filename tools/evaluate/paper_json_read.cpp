#include "core/evaluation/cell.h"
#include "core/imaging/file_error.h"
#include "core/imaging/image_file.h"
#include "core/process/configuration.h"
#include "tools/evaluate/paper_json_names.h"
#include "tools/evaluate/paper_result.h"
#include "tools/evaluate/shard.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

using Json = nlohmann::ordered_json;

/// Something in the file that our own writer would not have written.
class Unexpected : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

int whole(const Json& j, int lowest, int highest, const char* what) {
    if (!j.is_number_integer()) throw Unexpected(std::string(what) + " is no whole number");
    const auto value = j.get<std::int64_t>();
    if (value < lowest || value > highest)
        throw Unexpected(std::string(what) + " is " + std::to_string(value) + ", not in " +
                         std::to_string(lowest) + "…" + std::to_string(highest));
    return static_cast<int>(value);
}

std::optional<double> number(const Json& j, const char* what) {
    if (j.is_null()) return std::nullopt;
    if (!j.is_number()) throw Unexpected(std::string(what) + " is no number");
    return j.get<double>();
}

void take_state(PostRecord& post, const Json& j, int highest, const char* what) {
    const int state = whole(j, 0, highest, what);
    post.counts = (state & post_state::counts) != 0;
    post.found = (state & post_state::detected) != 0;
    post.identified = (state & post_state::identified) != 0;
    post.good = (state & post_state::good) != 0;
    post.both_edges = (state & post_state::both_edges) != 0;
}

constexpr int many = 1 << 20;

DetectorRecord detector_record(const Json& row) {
    DetectorRecord r;
    r.posts = whole(row[4], 0, many, frame_columns[4]);
    r.detected = whole(row[5], 0, r.posts, frame_columns[5]);
    r.identified = whole(row[6], 0, r.posts, frame_columns[6]);
    r.false_posts = whole(row[7], 0, many, frame_columns[7]);
    take_state(r.in_line, row[8], 31, frame_columns[8]);
    r.in_line.distance_error = number(row[9], frame_columns[9]);
    const auto left = number(row[10], frame_columns[10]);
    const auto right = number(row[11], frame_columns[11]);
    r.in_line.bearing_error = number(row[12], frame_columns[12]);
    if (left.has_value() != r.in_line.found || right.has_value() != r.in_line.found ||
        r.in_line.bearing_error.has_value() != r.in_line.found)
        throw Unexpected("edges and bearing do not go with what was detected");
    if (r.in_line.found) r.in_line.edges = {*left, *right};
    take_state(r.second, row[13], 7, frame_columns[13]);
    r.second.distance_error = number(row[14], frame_columns[14]);
    r.in_line.bound = number(row[15], frame_columns[15]);
    r.in_line.normalised_error = number(row[16], frame_columns[16]);
    if (r.in_line.good != r.in_line.normalised_error.has_value() ||
        (r.in_line.good && !r.in_line.distance_error))
        throw Unexpected("a post that is called good lacks an error, or the other way round");
    return r;
}

/// Rows come frame by frame, in each the detectors in order.
std::vector<FrameRecord> records_of(const Json& rows, int scenes, int detectors, int frames_per_cell) {
    if (!rows.is_array()) throw Unexpected("\"frames\" is no list");
    if (rows.size() % static_cast<std::size_t>(detectors) != 0)
        throw Unexpected("\"frames\" is not a row for each detector and frame");
    std::vector<FrameRecord> records;
    for (const Json& row : rows) {
        if (!row.is_array() || row.size() != frame_columns.size())
            throw Unexpected("a row of \"frames\" does not hold " + std::to_string(frame_columns.size()) +
                             " numbers");
        const FramePlace place{whole(row[0], 0, scenes - 1, frame_columns[0]),
                               whole(row[1], 0, cell_count - 1, frame_columns[1]),
                               whole(row[2], 0, frames_per_cell - 1, frame_columns[2])};
        const auto detector = static_cast<std::size_t>(whole(row[3], 0, detectors - 1, frame_columns[3]));
        if (detector == 0) {
            if (!records.empty() && records.back().place >= place)
                throw Unexpected("the rows of \"frames\" are not in order");
            records.push_back({place, {}});
        }
        if (records.empty() || records.back().place != place || records.back().detectors.size() != detector)
            throw Unexpected("the rows of \"frames\" are not in order");
        records.back().detectors.push_back(detector_record(row));
    }
    for (const FrameRecord& record : records)
        if (record.detectors.size() != static_cast<std::size_t>(detectors))
            throw Unexpected("a frame lacks a detector");
    return records;
}

PaperResult result_of(const Json& j) {
    PaperResult result;
    result.version = j.at("version").get<std::string>();
    result.command = j.at("command").get<std::string>();
    result.scenes = j.at("scenes").get<std::vector<std::string>>();
    result.detectors = j.at("detectors").get<std::vector<std::string>>();
    result.complete = j.at("complete").get<bool>();
    result.settings = j.at("settings");
    if (result.scenes.empty() || result.scenes.size() > 1000 || result.detectors.empty() ||
        result.detectors.size() > 1000)
        throw Unexpected("there is no scene or no detector");
    if (!result.settings.is_object() || !result.settings.contains("field") ||
        !result.settings.contains("camera"))
        throw Unexpected("\"settings\" lack field or camera");

    PaperOptions& options = result.options;
    if (!j.at("seed").is_number_unsigned()) throw Unexpected("\"seed\" is no whole number from 0");
    options.seed = j.at("seed").get<std::uint64_t>();
    options.size = j.at("size").get<std::string>();
    if (!parse_image_size(options.size)) throw Unexpected("\"size\" is no size such as 640x480");
    options.frames_per_cell = whole(j.at("frames_per_cell"), 1, most_frames_per_cell, "\"frames_per_cell\"");
    const Json& given = j.at("options");
    options.detectors = given.at("detectors").get<std::string>();
    options.scenes = given.at("scene").get<std::string>();
    options.settings = given.at("set").get<std::vector<std::string>>();
    options.field = given.at("field").get<std::string>();
    options.camera = given.at("camera").get<std::string>();
    options.colours = given.at("colours").get<std::string>();

    if (!j.at("shard").is_null()) result.shard = parse_shard(j.at("shard").get<std::string>());
    result.records = records_of(j.at("frames"), static_cast<int>(result.scenes.size()),
                                static_cast<int>(result.detectors.size()), options.frames_per_cell);
    return result;
}

}  // namespace

PaperResult read_paper_json(const std::filesystem::path& file) {
    std::vector<std::uint8_t> bytes;
    try {
        bytes = read_bytes(file);
    } catch (const FileError& error) {
        throw ConfigurationError(error.what());
    }
    const std::string no_result = file.string() + ": is no result of `goalmouth evaluate paper`: ";
    Json j;
    try {
        j = Json::parse(bytes);
    } catch (const Json::exception&) {
        throw ConfigurationError(no_result + "it is not JSON, or was cut short");
    }
    if (!j.is_object() || j.value("what", Json()) != Json(paper_what))
        throw ConfigurationError(no_result + "\"what\" does not say so");
    try {
        return result_of(j);
    } catch (const Unexpected& error) {
        throw ConfigurationError(no_result + error.what());
    } catch (const ConfigurationError& error) {
        throw ConfigurationError(no_result + error.what());
    } catch (const Json::exception& error) {
        throw ConfigurationError(no_result + "a field is missing or of another type (" + error.what() + ")");
    }
}

}  // namespace goalmouth
