#include "tools/evaluate/images_report.h"

#include "core/imaging/conversion.h"
#include "core/imaging/image_file.h"
#include "tools/evaluate/graph_settings.h"
#include "tools/evaluate/images_measures_report.h"
#include "tools/evaluate/report/figure.h"
#include "tools/evaluate/report/html_page.h"
#include "tools/evaluate/report/report_folder.h"
#include "tools/evaluate/scored_overlay.h"
#include "tools/goalmouth/image_chain.h"
#include "tools/goalmouth/output.h"
#include "tools/goalmouth/overlay.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

std::string caption_of(const ScoredPicture& picture) {
    return fmt::format("{} · {}: {} found, {} missed, {} wrong",
                       fs::path(picture.annotated.name).stem().string(), graph_name(picture.detector),
                       picture.found(), picture.missed(), picture.wrong());
}

Cell share(double value) {
    return Cell(100.0 * value, 1);
}

Table score_table(const ImagesResult& result) {
    Table table;
    table.caption = "Posts found by the rule, and posts that are none";
    table.columns = {"set",
                     "detector",
                     "pictures",
                     "posts",
                     "found",
                     "missed",
                     "wrong",
                     "recall %",
                     "precision %",
                     "pictures without a post",
                     "posts found there"};
    for (const ImageSetResult& set : result.sets) {
        for (const std::string& detector : result.options.detectors) {
            const ImageScore s = set.score(detector);
            table.rows.push_back({set.set, graph_name(detector), Cell(s.pictures, 0), Cell(s.posts, 0),
                                  Cell(s.found, 0), Cell(s.missed(), 0), Cell(s.wrong, 0), share(s.recall()),
                                  share(s.precision()), Cell(s.negatives, 0), Cell(s.wrong_on_negatives, 0)});
        }
    }
    return table;
}

std::string class_name(const WidthClass& c) {
    if (c.from <= 0.0) return fmt::format("below {:g}", c.to);
    if (!std::isfinite(c.to)) return fmt::format("{:g} and more", c.from);
    return fmt::format("{:g} to {:g}", c.from, c.to);
}

Table width_table(const ImagesResult& result) {
    Table table;
    table.caption = "Found of all posts, by their width at the foot in pixels";
    table.columns = {"set", "detector"};
    for (const WidthClass& c : by_width({})) table.columns.push_back(class_name(c));
    for (const ImageSetResult& set : result.sets) {
        for (const std::string& detector : result.options.detectors) {
            std::vector<Cell> row{set.set, graph_name(detector)};
            for (const WidthClass& c : by_width(set.of(detector))) {
                row.emplace_back(c.posts > 0 ? fmt::format("{} of {}", c.found, c.posts) : "–");
                row.back().number = true;
            }
            table.rows.push_back(row);
        }
    }
    return table;
}

/// Recall or precision of each detector, set by set.
Figure share_figure(const ImagesResult& result, const std::string& what,
                    double (ImageScore::*value)() const) {
    Figure figure;
    figure.title = what;
    figure.y_label = what + " [%]";
    figure.y_range = {0.0, 100.0};
    figure.width = 520;
    figure.height = 380;
    for (std::size_t i = 0; i < result.sets.size(); ++i)
        figure.x_ticks.push_back({static_cast<double>(i), result.sets[i].set});
    figure.x_range = {-0.6, static_cast<double>(result.sets.size()) - 0.4};
    for (const std::string& detector : result.options.detectors) {
        Series series{.name = graph_name(detector), .x = {}, .y = {}};
        series.style.kind = SeriesStyle::Kind::bars;
        for (std::size_t i = 0; i < result.sets.size(); ++i) {
            series.x.push_back(static_cast<double>(i));
            series.y.push_back(100.0 * (result.sets[i].score(detector).*value)());
        }
        figure.series.push_back(series);
    }
    return figure;
}

/// Reads each picture once and draws what each detector made of it.
class Overlays {
  public:
    Overlays(const ImagesResult& result, const ReportFolder& folder) {
        for (const ImageSetResult& set : result.sets)
            for (const ScoredPicture& picture : set.pictures) draw(picture, folder);
    }
    /// Where something failed, the worst first.
    std::vector<PagePicture> failures(const std::string& set, const std::string& detector) const {
        const auto found = failures_.find({set, detector});
        if (found == failures_.end()) return {};
        std::vector<Failure> sorted = found->second;
        std::stable_sort(sorted.begin(), sorted.end(),
                         [](const Failure& a, const Failure& b) { return a.mistakes > b.mistakes; });
        std::vector<PagePicture> pictures;
        for (const Failure& failure : sorted) pictures.push_back(failure.picture);
        return pictures;
    }

  private:
    struct Failure {
        int mistakes = 0;
        PagePicture picture;
    };

    void draw(const ScoredPicture& scored, const ReportFolder& folder) {
        cv::Mat picture = bgr_from_yuyv(load_scene(scored.annotated).image.view());
        draw_scored_picture(picture, scored);
        const fs::path name = unique(fs::path("overlays") / scored.annotated.set /
                                     graph_name(scored.detector) / fs::path(scored.annotated.name).stem());
        make_output_folder(folder.path() / name.parent_path(), "--report");
        write_picture(folder.path() / (name.string() + ".jpg"), picture, "--report");
        if (scored.failed()) {
            failures_[{scored.annotated.set, scored.detector}].push_back(
                {scored.missed() + scored.wrong(),
                 page_picture(picture, caption_of(scored), PictureFormat::jpeg, 640)});
        }
    }
    fs::path unique(const fs::path& name) {
        fs::path result = name;
        for (int n = 2; !used_.insert(result).second; ++n) result = name.string() + "_" + std::to_string(n);
        return result;
    }

    std::map<std::pair<std::string, std::string>, std::vector<Failure>> failures_;
    std::set<fs::path> used_;
};

std::string colours_sentence(const ImagesOptions& options) {
    if (!options.colours.empty()) return "The colour table is " + options.colours.filename().string() + ".";
    if (std::none_of(options.detectors.begin(), options.detectors.end(), takes_colours))
        return "No detector takes a colour table.";
    return fmt::format(
        "Colour tables were learnt from {} of the same set in {} folds: the table a picture is judged with "
        "never "
        "saw it.",
        options.without_labels ? "pictures, without their annotations," : "the annotations", options.folds);
}

}  // namespace

void draw_scored_picture(cv::Mat& picture, const ScoredPicture& scored) {
    draw_candidates(picture, scored.result.candidates);
    draw_border(picture, scored.result.border);
    draw_scored_posts(picture, scored.truth, scored.result.posts, scored.matching);
}

void write_images_report(const ImagesResult& result, const fs::path& target) {
    ReportFolder folder(target);
    HtmlPage page("Goalposts in annotated images",
                  "What each detector finds in real pictures in which a person marked the goalposts.");
    page.code(result.command);
    if (!result.complete()) page.note("Interrupted: not every picture was looked at.");

    page.section("Results");
    page.table(score_table(result));
    std::vector<DrawnFigure> figures;
    figures.push_back(
        draw_figure(share_figure(result, "Recall", &ImageScore::recall), folder.path(), "recall"));
    figures.push_back(
        draw_figure(share_figure(result, "Precision", &ImageScore::precision), folder.path(), "precision"));
    page.figures(figures, "Recall: found of all annotated posts. Precision: right of all that was found.");
    page.table(width_table(result));

    page.section("How it was counted");
    page.list(
        {fmt::format("A post is found where both its edges lie within {:g} % of its width, or {:g} px where "
                     "that is more, of the annotated ones, at a quarter and at three quarters of its visible "
                     "length, and the detection covers at least {:g} % of that length. One detection counts "
                     "for one post.",
                     100.0 * hand_marked_rule.fraction, hand_marked_rule.floor,
                     100.0 * hand_marked_rule.coverage),
         "Every other detection is wrong, but for those centred in a box that the annotations say to ignore.",
         colours_sentence(result.options), "goalmouth " + result.version});

    add_measures(page, result, folder.path());

    const Overlays overlays(result, folder);
    page.section("Failures");
    page.paragraph(
        std::string(scored_legend) +
        " Blue: the field's border. All pictures lie in overlays/ beside this page; a click on one "
        "here shows it large, another one closes it.");
    for (const ImageSetResult& set : result.sets) {
        for (const std::string& detector : result.options.detectors) {
            const std::vector<PagePicture> pictures = overlays.failures(set.set, detector);
            if (pictures.empty()) continue;
            page.details(fmt::format("{}, {}: {} of {} pictures", set.set, graph_name(detector),
                                     pictures.size(), set.of(detector).size()),
                         [&](HtmlPage& inside) { inside.pictures(pictures); });
        }
    }
    folder.write("index.html", page.html());
    folder.publish();
}

}  // namespace goalmouth
