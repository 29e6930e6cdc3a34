#include "tools/evaluate/merge.h"

#include "core/evaluation/cell.h"
#include "core/imaging/file_error.h"
#include "core/imaging/image_file.h"
#include "core/process/configuration.h"
#include "tools/evaluate/evaluate.h"
#include "tools/evaluate/localisation.h"
#include "tools/evaluate/paper.h"
#include "tools/evaluate/paper_report.h"
#include "tools/evaluate/paper_table.h"
#include "tools/evaluate/shard.h"
#include "tools/goalmouth/output.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <set>

#include <CLI/CLI.hpp>

namespace goalmouth {
namespace {

/// Whether a file says that it is one of `goalmouth evaluate localisation`. Whatever else is wrong with it is
/// for its reader to say.
bool is_localisation(const std::string& file) {
    try {
        const std::vector<std::uint8_t> bytes = read_bytes(file);
        const auto j = nlohmann::json::parse(bytes, nullptr, false);
        return j.is_object() && j.value("what", nlohmann::json()) == localisation_what;
    } catch (const FileError&) {
        return false;
    }
}

/// What the two files differ in, of all that must be the same; "" where they belong together.
std::string difference(const PaperResult& a, const PaperResult& b) {
    if (a.version != b.version) return "version";
    if (a.options.seed != b.options.seed) return "seed";
    if (a.options.size != b.options.size) return "size";
    if (a.options.frames_per_cell != b.options.frames_per_cell) return "frames per cell";
    if (a.scenes != b.scenes) return "scenes";
    if (a.detectors != b.detectors) return "detectors";
    if (a.settings != b.settings) return "settings";
    return {};
}

/// Which parts of the whole are not among the files, e.g. "3/4"; "" where that cannot be said.
std::string missing_parts(const std::vector<PaperResult>& results) {
    if (!results.front().shard) return {};
    const int parts = results.front().shard->parts;
    std::set<int> there;
    for (const auto& result : results) {
        if (!result.shard || result.shard->parts != parts) return {};
        there.insert(result.shard->part);
    }
    constexpr int most_named = 8;
    std::string text;
    int named = 0;
    for (int part = 1; part <= parts; ++part) {
        if (there.contains(part)) continue;
        if (named++ == most_named) return text + ", …";
        text += (text.empty() ? "" : ", ") + shard_text({part, parts});
    }
    return text;
}

[[noreturn]] void refuse_incomplete(const std::vector<PaperResult>& results,
                                    const std::vector<std::string>& files, std::size_t there,
                                    std::size_t all) {
    std::string text = std::to_string(all - there) + " of " + std::to_string(all) + " frames are missing";
    const std::string parts = missing_parts(results);
    if (!parts.empty()) text += ": no file holds shard " + parts;
    for (std::size_t i = 0; i < files.size(); ++i)
        if (!results[i].complete) text += "; " + files[i] + " was interrupted";
    throw ConfigurationError("merge: " + text + " (--partial merges all the same)");
}

}  // namespace

PaperResult merge_results(const std::vector<std::string>& files, bool partial) {
    std::vector<PaperResult> results;
    for (const auto& file : files) results.push_back(read_paper_json(file));
    const PaperResult& first = results.front();
    for (std::size_t i = 1; i < files.size(); ++i) {
        const std::string what = difference(first, results[i]);
        if (!what.empty())
            throw ConfigurationError(files[i] + ": does not belong to " + files.front() + ": another " +
                                     what);
    }

    std::map<FramePlace, std::size_t> owner;  // which file
    PaperResult merged = first;
    merged.records.clear();
    for (std::size_t i = 0; i < files.size(); ++i) {
        for (const FrameRecord& record : results[i].records) {
            const auto [there, is_new] = owner.emplace(record.place, i);
            if (!is_new)
                throw ConfigurationError(files[i] + ": holds frames that " + files[there->second] +
                                         " holds already");
            merged.records.push_back(record);
        }
    }
    std::sort(merged.records.begin(), merged.records.end(),
              [](const FrameRecord& a, const FrameRecord& b) { return a.place < b.place; });

    const std::size_t all =
        merged.scenes.size() * cell_count * static_cast<std::size_t>(merged.options.frames_per_cell);
    merged.complete = merged.records.size() == all;
    if (!merged.complete && !partial) refuse_incomplete(results, files, merged.records.size(), all);
    merged.shard = std::nullopt;
    merged.command = paper_command(merged.options, {});
    return merged;
}

void add_evaluate_merge(CLI::App& evaluate, Action& action) {
    struct Given {
        std::vector<std::string> files;
        std::string json;
        std::string report;
        bool partial = false;
    };
    const auto given = std::make_shared<Given>();
    CLI::App* verb = evaluate.add_subcommand(
        "merge", "Join what the shards of `goalmouth evaluate paper` or `localisation` gave");
    verb->add_option("SHARD", given->files, "JSON files of the shards, in any order")->required();
    verb->add_option("--json", given->json, "write the whole there");
    verb->add_option("--report", given->report, "folder for the page that the verb itself would have made");
    verb->add_flag("--partial", given->partial, "also where frames or runs are missing");
    verb->footer(
        "The result is that of a run that was never split; only the command line in it differs. Files that "
        "hold the\nsame frames, or come from another version, seed, size, scene, detector, setting or colour "
        "table, are refused.\nAt least one of --json and --report is needed. The report's pictures of "
        "failures "
        "are rendered anew with the\nfiles that the shards' command lines name; where those differ by now, "
        "it "
        "goes without.\n\n"
        "Example, four parts of one run:\n"
        "  for i in 1 2 3 4; do goalmouth evaluate paper --shard $i/4 --json part$i.json; done\n"
        "  goalmouth evaluate merge part*.json --json paper.json --report paper\n\n"
        "Exit code: 0 all went well, 2 the command line or a file is wrong or missing.");
    verb->callback([given, &action] {
        action = [given] {
            if (is_localisation(given->files.front()))
                return merge_localisation({given->files.begin(), given->files.end()}, given->json,
                                          given->report, given->partial);
            expect_outputs(given->json, given->report);
            const PaperResult result = merge_results(given->files, given->partial);
            if (!given->json.empty()) write_text(given->json, paper_json(result), "--json");
            if (!given->report.empty()) write_paper_report(result, nullptr, given->report);
            std::cout << paper_table(result);
            return 0;
        };
    });
}

}  // namespace goalmouth
