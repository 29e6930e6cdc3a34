#include "tools/colours/teach_window.h"

#include "tools/colours/click_tracker.h"
#include "tools/colours/teach_editor.h"
#include "tools/colours/teach_layout.h"
#include "tools/colours/teach_view.h"

#include <algorithm>
#include <stdexcept>

#include <opencv2/highgui.hpp>

namespace goalmouth {

namespace {

const char* const window = "goalmouth colours teach";

/// Of the codes that GTK and Qt give, those the editor knows; the low half alone counts, modifiers stand
/// above.
int editor_key(int code) {
    const int key = code & 0xffff;
    switch (key) {
        case 0xff0d:
        case 0xff8d:  // of the keypad
        case 10:
            return TeachEditor::enter;
        case 0xff1b:
            return TeachEditor::escape;
        case 0xff08:
            return TeachEditor::backspace;
        case 0xffab:
            return '+';
        case 0xffad:
            return '-';
        default:
            break;
    }
    if (key >= 0xffb0 && key <= 0xffb9) return '0' + (key - 0xffb0);  // of the keypad
    if (key >= 'A' && key <= 'Z') return key - 'A' + 'a';
    return key;
}

class Window {
  public:
    explicit Window(TeachEditor& editor)
        : editor_(editor), canvas_(first_canvas({editor.shown().width, editor.shown().height})) {
        open();
    }
    ~Window() {
        try {
            cv::destroyWindow(window);
        } catch (const cv::Exception&) {
            // It was closed by its user.
        }
    }
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Shows what has changed, waits a little for a key, and hands it on.
    void step() {
        constexpr int patience = 30;  // ms
        const bool resized = fit_canvas();
        if (editor_.take_changed() || resized) {
            cv::imshow(window, view_.draw(editor_, canvas_));
            cv::setWindowTitle(window, editor_.title());
        }
        const int code = cv::waitKeyEx(patience);
        if (code != -1) editor_.key(editor_key(code));
        if (cv::getWindowProperty(window, cv::WND_PROP_VISIBLE) >= 1) return;
        editor_.key('q');
        if (!editor_.done()) open();  // it asks
    }

  private:
    void open() {
        cv::namedWindow(window, cv::WINDOW_NORMAL | cv::WINDOW_FREERATIO | cv::WINDOW_GUI_NORMAL);
        cv::resizeWindow(window, canvas_);
        cv::imshow(window, view_.draw(editor_, canvas_));
        cv::setWindowTitle(window, editor_.title());
        cv::setMouseCallback(
            window,
            [](int event, int x, int y, int flags, void* self) {
                static_cast<Window*>(self)->mouse(event, {x, y}, flags);
            },
            this);
    }

    /// The canvas has the window's size, so that nothing is scaled. Returns whether that is a new one.
    bool fit_canvas() {
        const cv::Size size = cv::getWindowImageRect(window).size();
        if (size.empty()) return false;
        const cv::Size wanted(std::max(size.width, least_canvas().width),
                              std::max(size.height, least_canvas().height));
        if (wanted == canvas_) return false;
        canvas_ = wanted;
        return true;
    }

    void mouse(int event, cv::Point at, int flags) {
        const TeachLayout layout = layout_of(editor_, canvas_);
        const std::optional<cv::Point> pixel = layout.pixel_at(at);
        switch (event) {
            case cv::EVENT_MOUSEMOVE:
                if ((flags & cv::EVENT_FLAG_LBUTTON) != 0) clicks_.move();
                return editor_.point_at(pixel);
            case cv::EVENT_LBUTTONDOWN:
            case cv::EVENT_LBUTTONDBLCLK:
                return clicks_.press(at);
            case cv::EVENT_LBUTTONUP:
                return released(layout, at);
            case cv::EVENT_RBUTTONDOWN:
                if (pixel) editor_.right_click(*pixel);
                return;
            default:
                return;
        }
    }

    void released(const TeachLayout& layout, cv::Point at) {
        const auto what = clicks_.release(at);
        if (const auto* drag = std::get_if<Drag>(&what)) {
            const auto from = layout.pixel_at(drag->from), to = layout.pixel_at(drag->to);
            if (from && to) editor_.drag(*from, *to);
        } else if (const auto* click = std::get_if<Click>(&what)) {
            if (const auto pixel = layout.pixel_at(click->at)) editor_.click(*pixel);
            if (const auto colour = layout.class_at(click->at)) editor_.choose(*colour);
        }
    }

    TeachEditor& editor_;
    cv::Size canvas_;
    TeachView view_;
    ClickTracker clicks_;
};

}  // namespace

void run_teach_window(TeachEditor& editor, const std::function<bool()>& interrupted) {
    Window shown(editor);
    while (!editor.done() && !interrupted()) shown.step();
}

}  // namespace goalmouth
