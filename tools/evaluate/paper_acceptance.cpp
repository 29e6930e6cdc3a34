#include "tools/evaluate/paper_acceptance.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace goalmouth {
namespace {

constexpr double rmse_factor = 1.3;       // of the bound
constexpr double near_end = 3.0;          // m
constexpr double near_share = 0.0015;     // of the distance
constexpr double bias_share = 0.5;        // of the RMSE's bar
constexpr double gain_over_plain = 15.0;  // in lit
constexpr double gain_in_match = 4.0;
constexpr double median_factor = 1.5;  // of the bound, in clutter
constexpr double clutter_rmse_factor = 3.0;
constexpr double least_good = 0.95;
constexpr double lowest_normalised = 0.8;
constexpr double highest_normalised = 1.5;
constexpr double highest_in_clutter = 2.0;
constexpr const char* plain = "ransac";

std::string place(int cell) {
    const EvaluationCell at = evaluation_cell(cell);
    return fmt::format("{} cm, {}°", at.distance_cm, at.tilt_deg);
}

/// The cell in which a figure is farthest on the wrong side.
struct Worst {
    int cell = -1;
    double value = 0.0;
    int without = 0;  // cells that have no such figure
};

Worst worst_of(const RecordTable& table, std::size_t detector, std::size_t scene,
               const std::function<std::optional<double>(const Summary&, const EvaluationCell&)>& figure,
               bool largest = true) {
    Worst worst;
    for (int c = 0; c < cell_count; ++c) {
        const auto value = figure(table.cell(detector, scene, c), evaluation_cell(c));
        if (!value) {
            ++worst.without;
        } else if (worst.cell < 0 || (largest ? *value > worst.value : *value < worst.value)) {
            worst.cell = c;
            worst.value = *value;
        }
    }
    return worst;
}

/// The lines of one detector in one scene.
class Lines {
  public:
    Lines(const PaperResult& result, const RecordTable& table, std::size_t detector, std::size_t scene)
        : result_(result), table_(table), detector_(detector), scene_(scene) {}

    std::vector<AcceptanceLine> take() { return std::move(lines_); }

    void rmse_and_bias() {
        const Worst rmse = worst([](const Summary& cell, const EvaluationCell& at) -> std::optional<double> {
            if (!cell.in_line.distance || !cell.in_line.bound) return std::nullopt;
            return cell.in_line.distance->rmse / rmse_bar(at, *cell.in_line.bound);
        });
        add(fmt::format(
                "RMSE of every cell ≤ {} × bound, nearer than {:g} m at least {:g} % of the distance: ",
                rmse_factor, near_end, 100.0 * near_share) +
                with_place(rmse, "of that") + with_bound(rmse) + of_share(),
            rmse, rmse.value <= 1.0);
        const Worst bias = worst(
            [](const Summary& cell, const EvaluationCell& at) { return bias_to_bar(cell.in_line, at); });
        add(fmt::format("|bias| of every cell ≤ {} of that: ", bias_share) + with_place(bias, "of it"), bias,
            bias.value <= bias_share);
    }

    void gain(double asked) {
        const auto found = std::find(result_.detectors.begin(), result_.detectors.end(), plain);
        if (found == result_.detectors.end()) return;
        const auto other = static_cast<std::size_t>(found - result_.detectors.begin());
        const auto both = table_.compare(detector_, other, scene_);
        if (!both) {
            add(fmt::format("RMSE over all cells ≤ 1/{:g} of {}'s: nothing measured", asked, plain), false);
            return;
        }
        add(fmt::format("RMSE over all cells ≤ 1/{:g} of {}'s: 1/{:.1f} ({:.2f} of {:.2f} cm, {} frames)",
                        asked, plain, both->other_rmse / both->rmse, 100.0 * both->rmse,
                        100.0 * both->other_rmse, both->frames) +
                of_share(),
            both->rmse * asked <= both->other_rmse);
    }

    void clutter() {
        const PostSummary whole = table_.whole(detector_, scene_).in_line;
        const Worst median =
            worst([](const Summary& cell, const EvaluationCell&) { return cell.in_line.median_to_bound(); });
        add(fmt::format("median |error| of every cell ≤ {} × bound's: ", median_factor) +
                with_place(median, "of it") + over_all(whole.median_to_bound()),
            median, median.value <= median_factor);
        const Worst rmse =
            worst([](const Summary& cell, const EvaluationCell&) { return cell.in_line.rmse_to_bound(); });
        add(fmt::format("RMSE of every cell ≤ {:g} × bound: ", clutter_rmse_factor) +
                with_place(rmse, "of it") + with_bound(rmse) + over_all(whole.rmse_to_bound()),
            rmse, rmse.value <= clutter_rmse_factor);
        const Worst good = worst_of(
            table_, detector_, scene_,
            [](const Summary& cell, const EvaluationCell&) { return cell.in_line.good_share(); }, false);
        const double share = whole.good_share().value_or(0.0);
        add(fmt::format(
                "called good ≥ {:g} % of frames that show both edges: {:.1f} % ({} of {}; the detector "
                "found {} of them)",
                100.0 * least_good, 100.0 * share, whole.good, whole.both_edges,
                whole.both_edges_identified) +
                (good.cell < 0 ? std::string()
                               : fmt::format(", fewest {:.1f} %, {}", 100.0 * good.value, place(good.cell))),
            share >= least_good);
    }

    void consistency(double lowest, double highest) {
        const auto mean = table_.whole(detector_, scene_).in_line.normalised_error;
        const Worst most =
            worst([](const Summary& cell, const EvaluationCell&) { return cell.in_line.normalised_error; });
        add((lowest > 0.0 ? fmt::format("normalised squared error {} … {}: ", lowest, highest)
                          : fmt::format("normalised squared error ≤ {}: ", highest)) +
                (mean ? fmt::format("{:.2f}, most {:.2f}, {}", *mean, most.value, place(most.cell))
                      : std::string("nothing measured")),
            mean && *mean >= lowest && *mean <= highest);
    }

  private:
    template <class F>
    Worst worst(F figure) const {
        return worst_of(table_, detector_, scene_, figure);
    }

    static std::string with_place(const Worst& worst, const char* of) {
        if (worst.cell < 0) return "nothing measured";
        std::string text = fmt::format("at worst {:.2f} {}, {}", worst.value, of, place(worst.cell));
        if (worst.without > 0) text += fmt::format(", {} cells without", worst.without);
        return text;
    }

    std::string with_bound(const Worst& worst) const {
        if (worst.cell < 0) return {};
        const PostSummary cell = table_.cell(detector_, scene_, worst.cell).in_line;
        return fmt::format(" (RMSE {:.3f} cm, bound {:.3f} cm)", 100.0 * cell.distance->rmse,
                           100.0 * *cell.bound);
    }

    /// Of how many posts the line speaks.
    std::string of_share() const {
        const auto share = table_.whole(detector_, scene_).in_line.good_share();
        return share ? fmt::format("; of frames that show both edges it calls {:.1f} % good", 100.0 * *share)
                     : std::string();
    }

    static std::string over_all(const std::optional<double>& value) {
        return value ? fmt::format("; all cells together {:.2f}", *value) : std::string();
    }

    void add(const std::string& what, bool holds) {
        lines_.push_back({result_.detectors[detector_], result_.scenes[scene_], what, holds});
    }
    void add(const std::string& what, const Worst& worst, bool holds) {
        add(what, worst.cell >= 0 && worst.without == 0 && holds);
    }

    const PaperResult& result_;
    const RecordTable& table_;
    std::size_t detector_;
    std::size_t scene_;
    std::vector<AcceptanceLine> lines_;
};

}  // namespace

double rmse_bar(const EvaluationCell& cell, double bound) {
    const double bar = rmse_factor * bound;
    return cell.distance() < near_end ? std::max(bar, near_share * cell.distance()) : bar;
}

std::optional<double> bias_to_bar(const PostSummary& post, const EvaluationCell& cell) {
    if (!post.distance || !post.bound) return std::nullopt;
    return std::abs(post.distance->bias) / rmse_bar(cell, *post.bound);
}

std::string AcceptanceLine::text() const {
    return fmt::format("{}, {}: {} – {}", detector, scene, what, holds ? "holds" : "does not hold");
}

std::vector<AcceptanceLine> paper_acceptance(const PaperResult& result, const RecordTable& table) {
    std::vector<AcceptanceLine> all;
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        if (!table.refines(d)) continue;
        for (std::size_t s = 0; s < result.scenes.size(); ++s) {
            Lines lines(result, table, d, s);
            if (result.scenes[s] == "lit") {
                lines.rmse_and_bias();
                lines.gain(gain_over_plain);
                lines.consistency(lowest_normalised, highest_normalised);
            } else if (result.scenes[s] == "clutter") {
                lines.clutter();
                lines.consistency(0.0, highest_in_clutter);
            } else if (result.scenes[s] == "match") {
                lines.gain(gain_in_match);
            }
            for (AcceptanceLine& line : lines.take()) all.push_back(std::move(line));
        }
    }
    return all;
}

}  // namespace goalmouth
