#pragma once

#include "core/colour_teaching/teaching_session.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

namespace goalmouth {

enum class MarkTool { polygon, fill, box };
enum class ShownPanes { both, picture, segmentation };

/// A key or mouse button and what it does, for the window's help and the verb's.
struct EditorKey {
    std::string key;
    std::string meaning;
};
const std::vector<EditorKey>& editor_keys();

/// What keys and clicks do to a session, without a window: which class and tool is chosen, which picture and
/// which part of it is shown, which polygon is being drawn. Places are in px of the picture shown.
class TeachEditor {
  public:
    /// Writes what is to be kept. Returns what was written, a sentence; throws std::runtime_error with what
    /// could not be.
    using Save = std::function<std::string()>;
    TeachEditor(TeachingSession& session, std::vector<std::string> names, Save save);

    // Codes of the keys that are no characters.
    static constexpr int enter = 13, escape = 27, backspace = 8;

    void key(int code);
    void click(cv::Point at);
    void drag(cv::Point from, cv::Point to);
    void right_click(cv::Point at);
    /// Where the pointer is; nothing where it is beside the picture.
    void point_at(std::optional<cv::Point> at);
    void choose(Colour colour);

    /// Whether to end; the session's changes are kept or given up then.
    bool done() const { return done_; }
    /// Whether anything that is shown has changed since the last call.
    bool take_changed() { return std::exchange(changed_, false); }

    const TeachingSession& session() const { return session_; }
    const std::string& picture_name() const { return names_[picture_]; }
    std::size_t picture() const { return picture_; }
    /// The part of the picture that is shown.
    cv::Rect shown() const { return shown_; }
    int zoom() const { return zoom_; }
    ShownPanes panes() const { return panes_; }
    Colour colour() const { return colour_; }
    MarkTool tool() const { return tool_; }
    int tolerance() const { return tolerance_; }
    const std::vector<cv::Point>& corners() const { return corners_; }  // of the polygon or box being drawn
    std::optional<cv::Point> pointer() const { return pointer_; }
    bool help() const { return help_; }
    const std::string& message() const { return message_; }
    bool alarmed() const { return alarmed_; }  // the message is about something that went wrong
    /// One line: what stands in the window's title.
    std::string title() const;

  private:
    void say(std::string message, bool alarmed = false);
    void mark(const MarkShape& shape);
    void close_polygon();
    void show(std::size_t picture);
    void zoom_to(int zoom);
    void change_tolerance(int by);
    void choose(MarkTool tool);
    void save();
    void quit();
    void forget_question();
    void went(const std::optional<std::size_t>& picture, const char* what);

    TeachingSession& session_;
    std::vector<std::string> names_;
    Save save_;
    std::size_t picture_ = 0;
    cv::Rect shown_;
    int zoom_ = 1;
    ShownPanes panes_ = ShownPanes::both;
    Colour colour_ = Colour::field;
    MarkTool tool_ = MarkTool::polygon;
    int tolerance_ = 10;  // levels
    std::vector<cv::Point> corners_;
    std::optional<cv::Point> pointer_;
    bool help_ = false;
    bool asked_ = false;  // whether to quit without saving
    bool done_ = false;
    bool changed_ = true;
    std::string message_;
    bool alarmed_ = false;
};

}  // namespace goalmouth
