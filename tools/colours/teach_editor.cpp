#include "tools/colours/teach_editor.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

namespace goalmouth {

namespace {

constexpr int largest_zoom = 16;

std::string name_of(Colour colour) {
    return std::string(colour_names[static_cast<std::size_t>(colour)]);
}

std::string name_of(MarkTool tool) {
    return tool == MarkTool::polygon ? "polygon" : tool == MarkTool::fill ? "fill" : "box";
}

const char* how_to(MarkTool tool) {
    switch (tool) {
        case MarkTool::polygon:
            return "polygon: click its corners, right click or Enter closes it";
        case MarkTool::fill:
            return "fill: click; takes what is joined and like it. + and - change how like";
        case MarkTool::box:
            break;
    }
    return "box: drag, or click two opposite corners";
}

cv::Rect box_between(cv::Point a, cv::Point b) {
    return {cv::Point(std::min(a.x, b.x), std::min(a.y, b.y)),
            cv::Point(std::max(a.x, b.x) + 1, std::max(a.y, b.y) + 1)};
}

}  // namespace

const std::vector<EditorKey>& editor_keys() {
    static const std::vector<EditorKey> keys = {
        {"0 1 2 3 4 5", "class: unclassified, field, line, ball, goal, robot"},
        {"p", "polygon: click its corners; right click or Enter closes it"},
        {"f", "fill: click; takes all that is joined and like it"},
        {"+ -", "how like: tolerance of fill"},
        {"b", "box: drag, or click two opposite corners"},
        {"Backspace Esc", "last corner away; all corners away"},
        {"right click", "takes the mark under the pointer away"},
        {"u r", "undo, redo"},
        {"c", "takes all marks of the class away, in all pictures"},
        {". ,", "next, previous picture"},
        {"z x", "zoom in where the pointer is, out"},
        {"wheel", "magnifies the whole window (with Qt); drag moves it"},
        {"v", "picture and segmentation, or one of them alone"},
        {"s", "save the marks and the table"},
        {"q", "quit; asks where something is not saved"},
        {"h ?", "this help"},
    };
    return keys;
}

TeachEditor::TeachEditor(TeachingSession& session, std::vector<std::string> names, Save save)
    : session_(session), names_(std::move(names)), save_(std::move(save)) {
    if (session_.pictures() == 0 || names_.size() != session_.pictures())
        throw std::invalid_argument("an editor needs pictures, and a name for each");
    show(0);
    say("h: help. Choose a class (0 to 5), then mark what shows it");
}

void TeachEditor::say(std::string message, bool alarmed) {
    message_ = std::move(message);
    alarmed_ = alarmed;
    changed_ = true;
}

void TeachEditor::forget_question() {
    changed_ = changed_ || asked_;
    asked_ = false;
}

void TeachEditor::show(std::size_t picture) {
    picture_ = picture;
    zoom_ = 1;
    const YuyvView view = session_.picture(picture);
    shown_ = {0, 0, view.width, view.height};
    corners_.clear();
    pointer_.reset();
    changed_ = true;
}

void TeachEditor::zoom_to(int zoom) {
    const YuyvView view = session_.picture(picture_);
    zoom = std::clamp(zoom, 1, largest_zoom);
    const cv::Size size(std::max(1, view.width / zoom), std::max(1, view.height / zoom));
    // What is under the pointer stays there.
    const cv::Point at = pointer_.value_or((shown_.tl() + shown_.br()) / 2);
    const auto first = [](int place, int shown_first, int shown_size, int new_size, int all) {
        const double share = (place - shown_first + 0.5) / shown_size;
        return std::clamp(cvRound(place + 0.5 - share * new_size), 0, all - new_size);
    };
    shown_ = {first(at.x, shown_.x, shown_.width, size.width, view.width),
              first(at.y, shown_.y, shown_.height, size.height, view.height), size.width, size.height};
    zoom_ = zoom;
    changed_ = true;
}

void TeachEditor::choose(Colour colour) {
    colour_ = colour;
    say(name_of(colour) + ": mark what shows it");
}

void TeachEditor::choose(MarkTool tool) {
    tool_ = tool;
    corners_.clear();
    say(how_to(tool));
}

void TeachEditor::change_tolerance(int by) {
    tolerance_ = std::clamp(tolerance_ + by, 0, largest_tolerance);
    say(fmt::format("fill takes colours up to {} levels away", tolerance_));
}

void TeachEditor::mark(const MarkShape& shape) {
    corners_.clear();
    try {
        session_.add({picture_, colour_, shape});
    } catch (const std::invalid_argument& error) {
        return say(error.what(), true);
    }
    const std::size_t pixels = pixels_of(session_.marks().back()->colours);
    const std::string problem = session_.problem();
    say(fmt::format("{}: {} px of {}{}{}", name_of(tool_), pixels, name_of(colour_),
                    problem.empty() ? "" : "; ", problem),
        session_.table() && !problem.empty());
}

void TeachEditor::close_polygon() {
    if (corners_.size() < 3) return say("a polygon has at least three corners", true);
    mark(MarkedPolygon{corners_});
}

void TeachEditor::click(cv::Point at) {
    forget_question();
    if (tool_ == MarkTool::fill) return mark(MarkedFill{at, tolerance_});
    corners_.push_back(at);
    changed_ = true;
    if (tool_ == MarkTool::box && corners_.size() == 2)
        mark(MarkedBox{box_between(corners_[0], corners_[1])});
}

void TeachEditor::drag(cv::Point from, cv::Point to) {
    forget_question();
    if (tool_ == MarkTool::box) mark(MarkedBox{box_between(from, to)});
}

void TeachEditor::right_click(cv::Point at) {
    forget_question();
    if (tool_ == MarkTool::polygon && !corners_.empty()) return close_polygon();
    if (const auto under = session_.mark_at(picture_, at)) {
        session_.remove(*under);
        say("mark taken away");
    }
}

void TeachEditor::point_at(std::optional<cv::Point> at) {
    if (at == pointer_) return;
    pointer_ = at;
    changed_ = changed_ || tool_ == MarkTool::fill || !corners_.empty();
}

void TeachEditor::went(const std::optional<std::size_t>& picture, const char* what) {
    if (!picture) return say(std::string("nothing to ") + what);
    if (*picture != picture_) show(*picture);
    say(what);
}

void TeachEditor::save() {
    try {
        say(save_());
    } catch (const std::runtime_error& error) {
        say(error.what(), true);
    }
}

void TeachEditor::quit() {
    done_ = asked_ || !session_.changed();
    asked_ = true;
    if (!done_) say("marks are not saved: s saves them, q once more quits without", true);
}

void TeachEditor::key(int code) {
    if (code != 'q') forget_question();
    if (help_ && code == escape) {
        help_ = false;
        changed_ = true;
        return;
    }
    if (code >= '0' && code < '0' + colour_count) return choose(static_cast<Colour>(code - '0'));
    switch (code) {
        case 'p':
            return choose(MarkTool::polygon);
        case 'f':
            return choose(MarkTool::fill);
        case 'b':
            return choose(MarkTool::box);
        case '+':
        case '=':  // the key of + where it needs Shift
            return change_tolerance(1);
        case '-':
            return change_tolerance(-1);
        case enter:
            if (tool_ == MarkTool::polygon) close_polygon();
            return;
        case backspace:
            if (!corners_.empty()) corners_.pop_back();
            changed_ = true;
            return;
        case escape:
            corners_.clear();
            changed_ = true;
            return;
        case 'u':
            return went(session_.undo(), "undo");
        case 'r':
            return went(session_.redo(), "redo");
        case 'c':
            return say(session_.remove_class(colour_) ? "all marks of " + name_of(colour_) + " taken away"
                                                      : "nothing is marked " + name_of(colour_));
        case '.':
        case ',': {
            const std::size_t n = session_.pictures();
            show((picture_ + (code == '.' ? 1 : n - 1)) % n);
            return say(picture_name());
        }
        case 'z':
            return zoom_to(2 * zoom_);
        case 'x':
            return zoom_to(zoom_ / 2);
        case 'v':
            panes_ = static_cast<ShownPanes>((static_cast<int>(panes_) + 1) % 3);
            changed_ = true;
            return;
        case 's':
            return save();
        case 'q':
            return quit();
        case 'h':
        case '?':
            help_ = !help_;
            changed_ = true;
            return;
        default:
            return;
    }
}

std::string TeachEditor::title() const {
    const std::size_t marks = session_.marks().size();
    return fmt::format("goalmouth colours teach - {} - {} - {} - {} mark{}{}", picture_name(),
                       name_of(colour_), name_of(tool_), marks, marks == 1 ? "" : "s",
                       !session_.changed() ? ""
                       : asked_            ? ", not saved: quit?"
                                           : ", not saved");
}

}  // namespace goalmouth
