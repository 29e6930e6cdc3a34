#include "tools/evaluate/images_measures_report.h"

#include "core/imaging/conversion.h"
#include "tools/evaluate/graph_settings.h"
#include "tools/evaluate/report/figure.h"
#include "tools/evaluate/scored_overlay.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

constexpr double cm = 100.0;  // in a metre
constexpr std::size_t worst_shown = 6;

void add_errors(std::vector<Cell>& row, const std::optional<ErrorStatistics>& errors) {
    const double none = std::nan("");
    for (const double value :
         {errors ? errors->bias : none, errors ? errors->rmse : none, errors ? errors->median_abs : none})
        row.emplace_back(value, 2);
}

Table edge_table(const ImagesResult& result) {
    Table table;
    table.caption = "Edges at 1/4, 1/2 and 3/4 of the outlines' length: detected less outlined, in pixels";
    table.columns = {"set", "detector", "of", "posts"};
    for (int side = 0; side < 3; ++side)
        for (const char* name : {"mean", "rms", "median size"}) table.columns.emplace_back(name);
    table.columns.emplace_back("outline's own σ");
    table.groups = {{"", 4}, {"left edge", 3}, {"right edge", 3}, {"width", 3}, {"", 1}};
    for (const ImageSetResult& set : result.sets) {
        for (const std::string& detector : result.options.detectors) {
            for (const MeasuredGroup& group : groups(set.measured(detector))) {
                const EdgeSummary s = edge_summary(group.posts);
                std::vector<Cell> row{set.set, graph_name(detector), group.name,
                                      Cell(static_cast<double>(s.posts), 0)};
                add_errors(row, s.left);
                add_errors(row, s.right);
                add_errors(row, s.width);
                row.emplace_back(s.annotation_sigma.value_or(std::nan("")), 2);
                table.rows.push_back(row);
            }
        }
    }
    return table;
}

std::string group_name(const DistanceGroup& group) {
    if (group.detector.empty()) return "the outlines themselves";
    const std::string detector = graph_name(group.detector);
    return group.of == "all" ? detector : detector + ": " + group.of;
}

Table distance_table(const ImageSetResult& set, const std::vector<std::string>& detectors) {
    Table table;
    table.caption = "Distances in " + set.set + ": estimated less true";
    table.columns = {"detector", "true distance, m", "posts",          "RMSE, cm",
                     "bias, cm", "relative rms, %",  "median size, %", "posts without a distance"};
    const auto add = [&](const std::string& name, const std::string& range, const DistanceSummary& s) {
        table.rows.push_back({name, range, Cell(static_cast<double>(s.posts), 0), Cell(cm * s.errors.rmse, 1),
                              Cell(cm * s.errors.bias, 1), Cell(100.0 * s.relative_rms, 1),
                              Cell(100.0 * s.median_relative, 1), Cell(static_cast<double>(s.without), 0)});
    };
    for (const DistanceGroup& group : set.distances(detectors)) {
        const auto whole = distance_summary(group.samples);
        if (!whole) continue;
        for (const DistanceSummary& s : by_distance(group.samples))
            add(group_name(group), fmt::format("{:g} to {:g}", s.from, s.to), s);
        add(group_name(group), "all", *whole);
    }
    return table;
}

/// Estimated over true distance, or what is left between them.
Figure distance_figure(const ImageSetResult& set, const std::vector<std::string>& detectors, bool errors) {
    Figure figure;
    figure.title = set.set + (errors ? ": error of the distance" : ": distances");
    figure.x_label = "true distance [m]";
    figure.y_label = errors ? "estimated less true [cm]" : "estimated distance [m]";
    figure.diagonal = !errors;
    figure.width = 560;
    figure.height = 440;
    for (const DistanceGroup& group : set.distances(detectors)) {
        Series series{.name = group_name(group), .x = {}, .y = {}};
        series.style.kind = SeriesStyle::Kind::points;
        const auto place = std::find(detectors.begin(), detectors.end(), group.detector);
        series.style.colour = group.detector.empty()
                                  ? SeriesStyle::neutral
                                  : static_cast<int>(std::distance(detectors.begin(), place));
        series.style.hollow = group.of == "not refined" || group.detector.empty();
        for (const DistanceSample& sample : group.samples) {
            if (!sample.estimate) continue;
            series.x.push_back(sample.truth);
            series.y.push_back(errors ? cm * (*sample.estimate - sample.truth) : *sample.estimate);
        }
        if (!series.x.empty()) figure.series.push_back(series);
    }
    return figure;
}

/// What remains when the edges are right, in words.
std::string limits_sentence(const ImageSetResult& set) {
    const Field& field = *set.goals;
    return fmt::format(
        "What limits this comparison. The scale: 1 % of the camera's focal length, or {:.1f} mm of the {:g} "
        "cm that {} says a post is thick, is 1 % of every distance, so where both come from pictures like "
        "these the mean error over all posts proves nothing and its scatter does. The truth: it runs from "
        "where somebody put the robot's feet to the post's axis, but the camera hangs some centimetres in "
        "front of the feet (estimates should come out that much short) and swings aside as the robot leans; "
        "a heading that is some degrees off turns the view and leaves the distance. The outlines: an edge "
        "they have 1 px wrong is {:.0f} cm at 3 m. And not the edges but the formula: distance by width "
        "in the picture's plane, as the paper has it, comes out short by about the cosine squared of the "
        "angle between post and optical axis, while refinement and the outlines measure between planes.",
        10.0 * field.post_diameter, cm * field.post_diameter, set.field.filename().string(),
        cm * 9.0 / (set.pictures.front().result.camera.fx * field.post_diameter));
}

/// The post and its surroundings, enlarged, with outline and detection.
PagePicture close_up(const MeasuredPost& measured, const std::string& caption) {
    constexpr double margin = 0.15;  // of the longer side, all round
    constexpr int shown = 720;       // px high: the drawn lines, 3 px, are thin beside a post then
    const ScoredPicture& scored = *measured.picture;
    ReferencePost truth = scored.truth[measured.truth];
    Post post = measured.post();
    Eigen::AlignedBox2d box;
    for (const auto& p : {truth.left_top, truth.left_base, truth.right_top, truth.right_base, post.left_top,
                          post.left_base, post.right_top, post.right_base})
        box.extend(p);
    const double border = margin * box.sizes().maxCoeff();
    const cv::Mat whole = bgr_from_yuyv(load_scene(scored.annotated).image.view());
    const cv::Point from(static_cast<int>(box.min().x() - border), static_cast<int>(box.min().y() - border));
    const cv::Point to(static_cast<int>(box.max().x() + border), static_cast<int>(box.max().y() + border));
    const cv::Rect part = cv::Rect(from, to) & cv::Rect(0, 0, whole.cols, whole.rows);
    if (part.empty()) return page_picture(whole, caption, PictureFormat::jpeg, 640);
    const double scale = static_cast<double>(shown) / part.height;
    cv::Mat picture;
    cv::resize(whole(part), picture, {}, scale, scale, scale > 1.0 ? cv::INTER_CUBIC : cv::INTER_AREA);
    const auto move = [&](Eigen::Vector2d& p) {
        p = (p - Eigen::Vector2d(part.x - 0.5, part.y - 0.5)) * scale - Eigen::Vector2d(0.5, 0.5);
    };
    for (Eigen::Vector2d* p : {&truth.left_top, &truth.left_base, &truth.right_top, &truth.right_base,
                               &post.left_top, &post.left_base, &post.right_top, &post.right_base})
        move(*p);
    PostMatching matching;
    const bool found = scored.matching.found[measured.truth].has_value();
    matching.found = {found ? std::optional<std::size_t>(0) : std::nullopt};
    matching.verdicts = {scored.matching.verdicts[measured.detection]};
    draw_scored_posts(picture, std::span(&truth, 1), std::span(&post, 1), matching);
    return page_picture(picture, caption, PictureFormat::jpeg, 640);
}

std::string refined_text(const MeasuredPost& post) {
    if (post.refined()) return ", refined";
    const auto& how = post.picture->result.refinements[post.detection];
    return how && !how->reason.empty() ? ", not refined: " + how->reason : "";
}

std::string name_of(const MeasuredPost& post) {
    return fs::path(post.picture->annotated.name).stem().string();
}

std::string edge_caption(const MeasuredPost& post) {
    return fmt::format("{}: edges up to {:.1f} px off{}", name_of(post), post.largest_edge_error(),
                       refined_text(post));
}

std::string distance_caption(const MeasuredPost& post) {
    return fmt::format("{}: true {:.2f} m, estimated {:.2f} m ({:+.1f} %){}", name_of(post),
                       *post.true_distance, *post.distance,
                       100.0 * *post.distance_error() / *post.true_distance, refined_text(post));
}

void add_worst(HtmlPage& page, const ImageSetResult& set, const std::vector<std::string>& detectors,
               const std::function<double(const MeasuredPost&)>& badness,
               const std::function<std::string(const MeasuredPost&)>& caption) {
    for (const std::string& detector : detectors) {
        for (const MeasuredGroup& group : groups(set.measured(detector))) {
            std::vector<MeasuredPost> posts = group.posts;
            std::erase_if(posts, [&](const MeasuredPost& post) { return !(badness(post) > 0.0); });
            std::stable_sort(posts.begin(), posts.end(), [&](const MeasuredPost& a, const MeasuredPost& b) {
                return badness(a) > badness(b);
            });
            if (posts.size() > worst_shown) posts.resize(worst_shown);
            if (posts.empty()) continue;
            std::vector<PagePicture> pictures;
            for (const MeasuredPost& post : posts) pictures.push_back(close_up(post, caption(post)));
            page.details(fmt::format("{}, {}, {}: the worst {} of {}", set.set, graph_name(detector),
                                     group.name, pictures.size(), group.posts.size()),
                         [&](HtmlPage& inside) { inside.pictures(pictures); });
        }
    }
}

void add_distances(HtmlPage& page, const ImageSetResult& set, const ImagesResult& result,
                   const fs::path& folder, std::size_t number) {
    const std::vector<std::string>& detectors = result.options.detectors;
    const PlacementSummary placed = placement_summary(set.of(detectors.front()));
    page.subsection(set.set);
    page.paragraph(fmt::format(
        "Field: {}. By where the robot stood and looked, {} of {} outlined posts are one of its goalposts; "
        "their directions differ from that by {:.1f}° (rms).",
        set.goals->name, placed.posts - placed.unplaced, placed.posts,
        placed.direction_rms * 180.0 / std::numbers::pi));
    page.table(distance_table(set, detectors));
    const std::string stem = "distances" + std::to_string(number);
    page.figures({draw_figure(distance_figure(set, detectors, false), folder, stem),
                  draw_figure(distance_figure(set, detectors, true), folder, stem + "_errors")},
                 "Each point is a post. Filled: refined, or by a detector that does not refine; hollow: not "
                 "refined, or what the outlines themselves would say.");
    page.paragraph(limits_sentence(set));
    add_worst(
        page, set, detectors,
        [](const MeasuredPost& post) {
            const auto error = post.distance_error();
            return error ? std::abs(*error) / *post.true_distance : 0.0;
        },
        distance_caption);
}

}  // namespace

void add_measures(HtmlPage& page, const ImagesResult& result, const fs::path& folder) {
    page.section("Edges");
    page.paragraph(
        "Of posts that a detection means, however badly. What is smaller than the outlines' own σ says as "
        "much of them as of the detector.");
    page.table(edge_table(result));
    for (const ImageSetResult& set : result.sets)
        add_worst(
            page, set, result.options.detectors,
            [](const MeasuredPost& post) { return post.largest_edge_error(); }, edge_caption);

    const bool any = std::any_of(result.sets.begin(), result.sets.end(), [](const ImageSetResult& set) {
        return set.goals && !set.pictures.empty();
    });
    if (!any) return;
    page.section("Distances");
    for (std::size_t i = 0; i < result.sets.size(); ++i)
        if (result.sets[i].goals && !result.sets[i].pictures.empty())
            add_distances(page, result.sets[i], result, folder, i);
}

}  // namespace goalmouth
