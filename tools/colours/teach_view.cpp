#include "tools/colours/teach_view.h"

#include "core/imaging/colour_picture.h"
#include "core/imaging/conversion.h"
#include "tools/colours/teach_editor.h"
#include "tools/colours/teach_layout.h"

#include <algorithm>
#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

namespace goalmouth {

namespace {

const cv::Scalar background(32, 30, 28), bar(52, 48, 44), ink(235, 235, 235), faint(165, 165, 165),
    alarm(90, 110, 255), chosen(255, 190, 90), black(0, 0, 0);

constexpr double text_scale = 0.45;

/// putText() has no other characters.
std::string ascii(std::string text) {
    for (char& c : text)
        if (c < ' ' || c > '~') c = '?';
    return text;
}

int width_of(const std::string& text) {
    int baseline = 0;
    return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, text_scale, 1, &baseline).width;
}

/// In the line's middle, from `x` px right of its left end.
void write(cv::Mat& canvas, const std::string& text, const cv::Rect& line, int x, const cv::Scalar& colour) {
    cv::putText(canvas, ascii(text), {line.x + x, line.y + line.height - 8}, cv::FONT_HERSHEY_SIMPLEX,
                text_scale, colour, 1, cv::LINE_AA);
}

void fill(cv::Mat& canvas, const cv::Rect& box, const cv::Scalar& colour) {
    cv::rectangle(canvas, box, colour, cv::FILLED);
}

cv::Scalar scalar(Colour colour) {
    const cv::Vec3b c = display_colour(colour);
    return {static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
}

class Drawing {
  public:
    Drawing(const TeachEditor& editor, const cv::Mat& picture, const cv::Mat& segmentation, cv::Size size)
        : editor_(editor),
          picture_(picture),
          segmentation_(segmentation),
          layout_(layout_of(editor, size)),
          canvas_(size, CV_8UC3, background),
          image_(editor.session().picture(editor.picture())) {}

    cv::Mat drawn() {
        header();
        if (!layout_.picture.empty()) {
            put(picture_, layout_.picture);
            marks(layout_.picture);
            preview(layout_.picture);
            drawing(layout_.picture);
        }
        if (!layout_.segmentation.empty()) {
            segmentation(layout_.segmentation);
            drawing(layout_.segmentation);
        }
        classes();
        lines();
        if (editor_.help()) help();
        return canvas_;
    }

  private:
    void header() {
        fill(canvas_, layout_.header, bar);
        const cv::Size size(image_.width, image_.height);
        write(canvas_,
              fmt::format("{}/{}  {}  {}x{}{}", editor_.picture() + 1, editor_.session().pictures(),
                          editor_.picture_name(), size.width, size.height,
                          editor_.zoom() > 1 ? fmt::format("  zoom {}", editor_.zoom()) : ""),
              layout_.header, 8, ink);
        const std::string right = editor_.session().changed() ? "not saved   h: help" : "h: help";
        write(canvas_, right, layout_.header, layout_.header.width - width_of(right) - 8,
              editor_.session().changed() ? chosen : faint);
    }

    void put(const cv::Mat& whole, const cv::Rect& pane) {
        const cv::Mat part = whole(layout_.shown);
        cv::Mat to = canvas_(pane);
        cv::resize(part, to, to.size(), 0, 0, pane.width < part.cols ? cv::INTER_AREA : cv::INTER_NEAREST);
    }

    /// The pixels of the picture that are in `pixels`, as they are shown in a pane: CV_8UC1.
    cv::Mat in_pane(const MarkedPixels& pixels, const cv::Rect& pane) const {
        cv::Mat mask = cv::Mat::zeros(image_.height, image_.width, CV_8UC1);
        pixels.mask.copyTo(mask(pixels.where));
        cv::Mat shown;
        cv::resize(mask(layout_.shown), shown, pane.size(), 0, 0, cv::INTER_NEAREST);
        return shown;
    }

    /// Hatched and with an outline, in a colour and black, so that one of the two shows on any picture.
    void mark(const MarkedPixels& pixels, const cv::Scalar& colour, const cv::Rect& pane) {
        constexpr int hatch = 9;  // px
        cv::Mat part = canvas_(pane);
        const cv::Mat mask = in_pane(pixels, pane);
        const cv::Vec3b bright(cv::saturate_cast<std::uint8_t>(colour[0]),
                               cv::saturate_cast<std::uint8_t>(colour[1]),
                               cv::saturate_cast<std::uint8_t>(colour[2]));
        for (int y = 0; y < part.rows; ++y) {
            const std::uint8_t* covered = mask.ptr<std::uint8_t>(y);
            auto* row = part.ptr<cv::Vec3b>(y);
            for (int x = (hatch - y % hatch) % hatch; x + 1 < part.cols; x += hatch) {
                if (covered[x] != 0) row[x] = bright;
                if (covered[x + 1] != 0) row[x + 1] = {0, 0, 0};
            }
        }
        std::vector<std::vector<cv::Point>> contours;
        cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
        cv::polylines(part, contours, true, black, 3);
        cv::polylines(part, contours, true, colour, 1);
    }

    void marks(const cv::Rect& pane) {
        for (const auto& each : editor_.session().marks())
            if (each->mark.picture == editor_.picture()) mark(each->pixels, scalar(each->mark.colour), pane);
    }

    /// What a click would fill, where it is not filled yet.
    void preview(const cv::Rect& pane) {
        const auto at = editor_.pointer();
        if (!at || editor_.tool() != MarkTool::fill) return;
        const auto under = editor_.session().mark_at(editor_.picture(), *at);
        if (under && editor_.session().marks()[*under]->mark.colour == editor_.colour()) return;
        const cv::Mat shown = in_pane(marked_pixels(MarkedFill{*at, editor_.tolerance()}, image_), pane);
        cv::Mat part = canvas_(pane);
        cv::Mat tinted;
        cv::addWeighted(part, 0.45, cv::Mat(part.size(), part.type(), chosen), 0.55, 0.0, tinted);
        tinted.copyTo(part, shown);
    }

    /// The corners set so far, and the line to the pointer.
    void drawing(const cv::Rect& pane) {
        std::vector<cv::Point> line = editor_.corners();
        if (line.empty()) return;
        if (const auto at = editor_.pointer()) line.push_back(*at);
        for (cv::Point& p : line) p = layout_.place_of(pane, p) - pane.tl();
        cv::Mat part = canvas_(pane);
        if (editor_.tool() == MarkTool::box) {
            cv::rectangle(part, line.front(), line.back(), black, 3);
            cv::rectangle(part, line.front(), line.back(), chosen, 1);
            return;
        }
        cv::polylines(part, line, false, black, 3, cv::LINE_AA);
        cv::polylines(part, line, false, chosen, 1, cv::LINE_AA);
        for (std::size_t i = 0; i < editor_.corners().size(); ++i) {
            cv::circle(part, line[i], 4, black, cv::FILLED, cv::LINE_AA);
            cv::circle(part, line[i], 3, chosen, cv::FILLED, cv::LINE_AA);
        }
    }

    void segmentation(const cv::Rect& pane) {
        if (!segmentation_.empty()) return put(segmentation_, pane);
        fill(canvas_, pane, scalar(Colour::unclassified));
        const std::string text = "what the table will make of it";
        write(canvas_, text, {pane.x, pane.y + pane.height / 2 - 12, pane.width, 24},
              (pane.width - width_of(text)) / 2, faint);
    }

    void classes() {
        const auto samples = editor_.session().samples();
        for (std::size_t c = 0; c < colour_count; ++c) {
            const auto colour = static_cast<Colour>(c);
            const cv::Rect& box = layout_.classes[c];
            const bool is_chosen = colour == editor_.colour();
            fill(canvas_, box, is_chosen ? cv::Scalar(88, 78, 66) : bar);
            if (is_chosen) fill(canvas_, {box.x, box.y, box.width, 2}, chosen);
            const cv::Rect swatch(box.x + 26, box.y + 6, 12, 12);
            fill(canvas_, swatch, scalar(colour));
            cv::rectangle(canvas_, swatch, faint);
            write(canvas_, std::to_string(c), box, 10, is_chosen ? ink : faint);
            const std::string count = samples[c] > 0 ? std::to_string(samples[c]) : "";
            const std::string name(colour_names[c]);
            write(canvas_, name, box, 44, is_chosen ? ink : faint);
            if (44 + width_of(name) + 8 + width_of(count) + 6 < box.width)
                write(canvas_, count, box, box.width - width_of(count) - 8, faint);
        }
    }

    void lines() {
        const auto tool = [&](MarkTool which, const std::string& text, int x) {
            const bool is_chosen = editor_.tool() == which;
            write(canvas_, text, layout_.tool_line, x, is_chosen ? chosen : faint);
            return x + width_of(text) + 22;
        };
        int x = tool(MarkTool::polygon, "p: polygon", 10);
        x = tool(MarkTool::fill, fmt::format("f: fill, tolerance {} (+ -)", editor_.tolerance()), x);
        x = tool(MarkTool::box, "b: box", x);
        const std::string keys = "u r: undo, redo   , . : picture   z x: zoom   v: view   s: save   q: quit";
        if (x + width_of(keys) + 8 < layout_.tool_line.width)
            write(canvas_, keys, layout_.tool_line, layout_.tool_line.width - width_of(keys) - 8, faint);
        write(canvas_, editor_.message(), layout_.message_line, 10, editor_.alarmed() ? alarm : ink);
    }

    void help() {
        constexpr int row = 22, keys_width = 150;
        int widest = 0;
        for (const EditorKey& key : editor_keys()) widest = std::max(widest, width_of(key.meaning));
        const cv::Size size(keys_width + widest + 40, static_cast<int>(editor_keys().size()) * row + 24);
        const cv::Rect box =
            cv::Rect({(canvas_.cols - size.width) / 2, (canvas_.rows - size.height) / 2}, size) &
            cv::Rect({0, 0}, canvas_.size());
        cv::Mat part = canvas_(box);
        cv::addWeighted(part, 0.08, cv::Mat(part.size(), part.type(), background), 0.92, 0.0, part);
        cv::rectangle(canvas_, box, chosen);
        int y = box.y + 10;
        for (const EditorKey& key : editor_keys()) {
            const cv::Rect line(box.x, y, box.width, row);
            write(canvas_, key.key, line, 18, chosen);
            write(canvas_, key.meaning, line, 18 + keys_width, ink);
            y += row;
        }
    }

    const TeachEditor& editor_;
    const cv::Mat& picture_;
    const cv::Mat& segmentation_;
    TeachLayout layout_;
    cv::Mat canvas_;
    YuyvView image_;
};

}  // namespace

void TeachView::look_at(const TeachEditor& editor) {
    const TeachingSession& session = editor.session();
    const bool new_picture = picture_.empty() || number_ != editor.picture();
    if (!new_picture && marks_ == session.marks()) return;
    const YuyvView image = session.picture(editor.picture());
    if (new_picture) picture_ = bgr_from_yuyv(image);
    segmentation_ = session.table() ? segmentation_picture(image, *session.table()) : cv::Mat();
    number_ = editor.picture();
    marks_ = session.marks();
}

cv::Mat TeachView::draw(const TeachEditor& editor, cv::Size canvas) {
    look_at(editor);
    return Drawing(editor, picture_, segmentation_, canvas).drawn();
}

}  // namespace goalmouth
