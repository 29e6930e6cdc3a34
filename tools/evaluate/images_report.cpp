#include "tools/evaluate/images_report.h"

#include "core/imaging/conversion.h"
#include "core/imaging/image_file.h"
#include "tools/evaluate/graph_settings.h"
#include "tools/evaluate/report/figure.h"
#include "tools/evaluate/report/html_page.h"
#include "tools/evaluate/report/report_folder.h"
#include "tools/goalmouth/output.h"
#include "tools/goalmouth/overlay.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

#include <opencv2/imgproc.hpp>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

// BGR
const cv::Scalar shade(0, 0, 0);
const cv::Scalar truth_found(255, 255, 255);
const cv::Scalar truth_missed(0, 165, 255);
const cv::Scalar right_colour(60, 220, 60);
const cv::Scalar wrong_colour(60, 60, 255);
const cv::Scalar ignored_colour(190, 190, 190);

constexpr int fraction_bits = 4;

struct Outline {
    Eigen::Vector2d left_top, left_base, right_top, right_base;
};

cv::Point fixed(const Eigen::Vector2d& p) {
    const auto coordinate = [](double v) {
        return static_cast<int>(std::lround(std::clamp(v, -1e5, 1e5) * (1 << fraction_bits)));
    };
    return {coordinate(p.x()), coordinate(p.y())};
}

void draw_outline(cv::Mat& picture, const Outline& o, const cv::Scalar& colour, double width) {
    const double scale = std::max(1.0, picture.cols / 640.0);
    for (const bool under : {true, false}) {
        const int thick = std::max(1, static_cast<int>(std::lround((under ? width + 2.0 : width) * scale)));
        const cv::Scalar& ink = under ? shade : colour;
        const auto edge = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
            cv::line(picture, fixed(a), fixed(b), ink, thick, cv::LINE_AA, fraction_bits);
        };
        edge(o.left_top, o.left_base);
        edge(o.right_top, o.right_base);
        edge(o.left_base, o.right_base);
        edge(o.left_top, o.right_top);
    }
}

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
    return fmt::format(
        "Colour tables were learnt from the annotations of the same set in {} folds: the table a picture is "
        "judged with never saw it.",
        options.folds);
}

}  // namespace

void draw_scored_picture(cv::Mat& picture, const ScoredPicture& scored) {
    draw_candidates(picture, scored.result.candidates);
    draw_border(picture, scored.result.border);
    for (std::size_t i = 0; i < scored.truth.size(); ++i) {
        const ReferencePost& t = scored.truth[i];
        const bool found = scored.matching.found[i].has_value();
        draw_outline(picture, {t.left_top, t.left_base, t.right_top, t.right_base},
                     found ? truth_found : truth_missed, found ? 1.0 : 2.0);
    }
    for (std::size_t i = 0; i < scored.result.posts.size(); ++i) {
        const Post& p = scored.result.posts[i];
        const Verdict verdict = scored.matching.verdicts[i];
        const cv::Scalar& colour = verdict == Verdict::found     ? right_colour
                                   : verdict == Verdict::ignored ? ignored_colour
                                                                 : wrong_colour;
        draw_outline(picture, {p.left_top, p.left_base, p.right_top, p.right_base}, colour, 1.0);
    }
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

    const Overlays overlays(result, folder);
    page.section("Failures");
    page.paragraph(
        "White: an annotated post that was found; orange: one that was missed. Green: a detection that is "
        "right; red: one that is wrong; grey: ignored. Blue: the field's border. All pictures lie in "
        "overlays/ beside this page.");
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
