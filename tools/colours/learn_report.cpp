#include "tools/colours/learn_report.h"

#include "core/colour_learning/lesson.h"
#include "core/imaging/colour_picture.h"
#include "core/imaging/conversion.h"
#include "tools/evaluate/report/html_page.h"
#include "tools/evaluate/report/report_folder.h"
#include "tools/goalmouth/output.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

namespace goalmouth {

namespace {

constexpr int sheet_columns = 2;
constexpr int sheet_width = 300;   // px of one picture on the sheet
constexpr int cluster_side = 512;  // px
const cv::Scalar ink(230, 230, 230);
const cv::Scalar found_post(255, 0, 255);

void write(cv::Mat& picture, const std::string& text, cv::Point where) {
    cv::putText(picture, text, where, cv::FONT_HERSHEY_SIMPLEX, 0.42, ink, 1, cv::LINE_AA);
}

/// What a picture taught: classes in their colours, violet where it taught nothing.
cv::Mat labels_picture(const cv::Mat& labels) {
    cv::Mat picture(labels.size(), CV_8UC3, cv::Scalar(90, 30, 90));
    for (int y = 0; y < labels.rows; ++y)
        for (int x = 0; x < labels.cols; ++x)
            if (const std::uint8_t label = labels.at<std::uint8_t>(y, x); label < colour_count)
                picture.at<cv::Vec3b>(y, x) = display_colour(static_cast<Colour>(label));
    return picture;
}

/// The picture with the posts it was taken to show, what it taught, and what the table makes of it.
cv::Mat strip(const LearntPicture& learnt, const ColourTable& table) {
    cv::Mat picture = bgr_from_yuyv(learnt.scene.image.view());
    for (const PostOutline& post : learnt.scene.posts)
        cv::polylines(picture, std::vector<std::vector<cv::Point>>{corners(post)}, true, found_post, 2,
                      cv::LINE_AA);
    cv::Mat beside;
    cv::hconcat(std::vector<cv::Mat>{picture, labels_picture(learnt.labels),
                                     segmentation_picture(learnt.scene.image.view(), table)},
                beside);
    return beside;
}

cv::Mat contact_sheet(const std::vector<cv::Mat>& strips, const std::vector<NamedPicture>& pictures) {
    constexpr int caption = 16;
    std::vector<cv::Mat> rows;
    for (std::size_t i = 0; i < strips.size(); i += sheet_columns) {
        cv::Mat row;
        for (std::size_t k = i; k < i + sheet_columns; ++k) {
            cv::Mat cell;
            const cv::Mat& strip = strips[std::min(k, strips.size() - 1)];
            cv::resize(strip, cell, {3 * sheet_width, std::max(1, 3 * sheet_width * strip.rows / strip.cols)},
                       0, 0, cv::INTER_AREA);
            cv::copyMakeBorder(cell, cell, caption, 2, 2, 6, cv::BORDER_CONSTANT);
            if (k < strips.size()) {
                write(cell, pictures[k].name, {4, caption - 4});
            } else {
                cell.setTo(0);
            }
            if (row.empty()) {
                row = cell;
            } else {
                const int height = std::max(row.rows, cell.rows);
                cv::copyMakeBorder(row, row, 0, height - row.rows, 0, 0, cv::BORDER_CONSTANT);
                cv::copyMakeBorder(cell, cell, 0, height - cell.rows, 0, 0, cv::BORDER_CONSTANT);
                cv::hconcat(row, cell, row);
            }
        }
        rows.push_back(row);
    }
    cv::Mat sheet;
    cv::vconcat(rows, sheet);
    return sheet;
}

/// How the samples of each class lie: left in the chroma plane (Cb to the right, Cr upwards), right luma
/// (upwards) over the distance from grey. The more frequent a colour in its class, the brighter its dot.
cv::Mat cluster_picture(const std::vector<NamedPicture>& pictures, const LearntColours& learnt) {
    constexpr int cells = 128;
    std::array<std::array<cv::Mat, colour_count>, 2> counts;
    for (auto& panel : counts)
        for (cv::Mat& of_class : panel) of_class = cv::Mat::zeros(cells, cells, CV_32F);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const Lesson lesson{pictures[i].image.view(), learnt.pictures[i].labels};
        lesson.each([&](Ycbcr p, std::uint8_t label) {
            const double chroma = std::min(127.0, std::hypot(p.cb - 128.0, p.cr - 128.0));
            counts[0][label].at<float>(cells - 1 - p.cr / 2, p.cb / 2) += 1.0F;
            counts[1][label].at<float>(cells - 1 - p.y / 2, static_cast<int>(chroma)) += 1.0F;
        });
    }
    cv::Mat whole;
    for (auto& panel : counts) {
        cv::Mat drawn(cells, cells, CV_8UC3, cv::Scalar(20, 20, 20));
        for (int y = 0; y < cells; ++y) {
            for (int x = 0; x < cells; ++x) {
                double most = 0.0;
                for (std::size_t c = 0; c < colour_count; ++c) {
                    const double n = panel[c].at<float>(y, x);
                    const double share = n / std::max(learnt.classes[c].samples, 1.0);
                    // Unclassified is everything: it shows where nothing else is.
                    const double weight = c == 0 ? 0.05 * share : share;
                    if (n == 0.0 || weight <= most) continue;
                    most = weight;
                    const cv::Vec3b colour =
                        c == 0 ? cv::Vec3b(110, 90, 90) : display_colour(static_cast<Colour>(c));
                    const double bright = std::clamp(1.0 + 0.25 * std::log10(share * 100.0), 0.25, 1.0);
                    drawn.at<cv::Vec3b>(y, x) = colour * bright;
                }
            }
        }
        cv::resize(drawn, drawn, {cluster_side, cluster_side}, 0, 0, cv::INTER_NEAREST);
        cv::copyMakeBorder(drawn, drawn, 24, 4, 4, 4, cv::BORDER_CONSTANT);
        write(drawn,
              whole.empty() ? "samples: Cb to the right, Cr upwards"
                            : "samples: distance from grey to the right, Y upwards",
              {6, 16});
        if (whole.empty()) {
            whole = drawn;
        } else {
            cv::hconcat(whole, drawn, whole);
        }
    }
    return whole;
}

Table class_table(const LearntColours& learnt) {
    Table table;
    table.caption = "What each class was learnt from, and how well pictures agree about it";
    table.columns = {"class", "pictures", "pixels",      "mean Y",    "Cb",
                     "Cr",    "recall %", "precision %", "confidence"};
    for (std::size_t c = 0; c < colour_count; ++c) {
        const LearntClass& k = learnt.classes[c];
        const double missing = std::nan("");
        const bool any = k.samples > 0.0;
        table.rows.push_back(
            {std::string(colour_names[c]), Cell(k.pictures, 0), Cell(k.samples, 0),
             Cell(any ? k.mean.y : missing, 0), Cell(any ? k.mean.cb : missing, 0),
             Cell(any ? k.mean.cr : missing, 0), Cell(k.recall ? 100.0 * *k.recall : missing, 1),
             Cell(k.precision ? 100.0 * *k.precision : missing, 1), Cell(any ? k.confidence() : missing, 2)});
    }
    return table;
}

}  // namespace

void write_learn_report(const LearnColoursOptions& options, const std::vector<NamedPicture>& pictures,
                        const LearntColours& learnt) {
    ReportFolder folder(options.report);
    std::vector<cv::Mat> strips;
    for (const LearntPicture& picture : learnt.pictures) strips.push_back(strip(picture, learnt.table));
    const cv::Mat clusters = cluster_picture(pictures, learnt);
    const cv::Mat slices = table_picture(learnt.table);
    write_picture(folder.path() / "contact_sheet.png", contact_sheet(strips, pictures), "--report");
    write_picture(folder.path() / "clusters.png", clusters, "--report");
    write_picture(folder.path() / "table.png", slices, "--report");

    HtmlPage page("Colours learnt without labels", "The table " + learnt.table.name() + ".");
    page.list(learnt.table.provenance());
    page.section("Classes");
    page.table(class_table(learnt));
    page.paragraph(
        "Recall and precision: two tables are learnt from every other picture each and tried on the rest. "
        "They are "
        "measured against what the pictures were taken to show, not against what a person says. Confidence "
        "is their "
        "harmonic mean.");
    page.picture(page_picture(clusters, "How the samples lie", PictureFormat::png, 1100));
    page.picture(page_picture(slices, "The table, in slices of equal luma", PictureFormat::png, 1700));
    page.section("Pictures");
    page.paragraph(
        "Left: the picture, with the posts it was taken to show. Middle: what it taught; violet taught "
        "nothing. "
        "Right: what the table makes of it.");
    std::vector<PagePicture> shown;
    for (std::size_t i = 0; i < strips.size(); ++i)
        shown.push_back(page_picture(strips[i], pictures[i].name));
    page.pictures(shown);
    folder.write("index.html", page.html());
    folder.publish();
}

}  // namespace goalmouth
