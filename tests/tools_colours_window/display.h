#pragma once

#include "tests/support/data.h"
#include "tests/support/processes.h"

#include <memory>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace goalmouth::test {

/// Why there can be no display here, to follow "skipped: "; "" where there can.
std::string display_problem();

/// An X server without a screen that anybody sees, which ends with the object. Programs started after it, by
/// this process, show their windows there.
class Display {
  public:
    Display();
    ~Display();

    /// Whether a window with this in its title is there, or comes within a generous limit. A regular
    /// expression.
    bool shows(const std::string& title);
    /// Moves the pointer to a place in the window found last. Keys go where the pointer is.
    void point_at(cv::Point at);
    void click(cv::Point at, int button = 1);
    void drag(cv::Point from, cv::Point to);
    void key(const std::string& name);
    /// The window's size.
    cv::Size size();

  private:
    /// Exit code of xdotool, and what it printed.
    std::pair<int, std::string> xdotool(const std::vector<std::string>& arguments);
    void expect(const std::vector<std::string>& arguments);

    TemporaryFolder home_;
    std::unique_ptr<Running> server_;
    std::string window_;
};

}  // namespace goalmouth::test
