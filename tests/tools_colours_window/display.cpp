#include "tests/tools_colours_window/display.h"

#include "tests/support/files.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>

namespace goalmouth::test {

namespace {

bool starts(const std::vector<std::string>& command) {
    Running program(command, new_mark());
    return program.wait() != 127;
}

/// The server writes the number of its display as a line of its own, among what else it says.
std::string number_in(const std::string& output) {
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
        if (!lines.eof() && !line.empty() && line.find_first_not_of("0123456789") == std::string::npos)
            return line;
    }
    return {};
}

}  // namespace

std::string display_problem() {
    if (!starts({"Xvfb", "-help"})) return "no Xvfb (Debian: xvfb)";
    if (!starts({"xdotool", "version"})) return "no xdotool (Debian: xdotool)";
    return {};
}

// Without -noreset the server turns away who connects while it starts over, which it does each time its last
// client leaves: here, each xdotool until the window is there.
Display::Display()
    : server_(
          std::make_unique<Running>(std::vector<std::string>{"Xvfb", "-displayfd", "1", "-screen", "0",
                                                             "1366x768x24", "-nolisten", "tcp", "-noreset"},
                                    new_mark())) {
    std::string number;
    if (!eventually([&] { return !(number = number_in(server_->output())).empty(); }))
        throw std::runtime_error("Xvfb does not start: " + server_->output());
    ::setenv("DISPLAY", (":" + number).c_str(), 1);
    ::setenv("HOME", home_.path().c_str(), 1);
    ::setenv("XDG_RUNTIME_DIR", home_.path().c_str(), 1);
    // Sanitizers would end a program with their code for what the desktop's libraries do.
    write_text(home_.path() / "not_ours", "leak:libdbus-1\n");
    const std::string suppressions = (home_.path() / "not_ours").string();
    ::setenv("LSAN_OPTIONS", ("print_suppressions=0:suppressions=" + suppressions).c_str(), 1);
    ::setenv("TSAN_OPTIONS", "ignore_noninstrumented_modules=1", 1);
    // What a developer's own desktop may say.
    for (const char* name :
         {"WAYLAND_DISPLAY", "XAUTHORITY", "QT_QPA_PLATFORM", "QT_SCALE_FACTOR", "DBUS_SESSION_BUS_ADDRESS"})
        ::unsetenv(name);
}

Display::~Display() {
    ::unsetenv("DISPLAY");
}

std::pair<int, std::string> Display::xdotool(const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {"xdotool"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    Running program(command, new_mark());
    const int code = program.wait();
    return {code, program.output()};
}

void Display::expect(const std::vector<std::string>& arguments) {
    const auto [code, output] = xdotool(arguments);
    EXPECT_EQ(code, 0) << output;
}

bool Display::shows(const std::string& title) {
    return eventually([&] {
        const auto [code, output] = xdotool({"search", "--onlyvisible", "--name", title});
        if (code != 0) return false;
        std::istringstream(output) >> window_;
        return true;
    });
}

void Display::point_at(cv::Point at) {
    expect({"mousemove", "--window", window_, std::to_string(at.x), std::to_string(at.y)});
}

void Display::click(cv::Point at, int button) {
    point_at(at);
    expect({"click", std::to_string(button)});
}

void Display::drag(cv::Point from, cv::Point to) {
    point_at(from);
    expect({"mousedown", "1"});
    point_at((from + to) / 2);
    point_at(to);
    expect({"mouseup", "1"});
}

void Display::key(const std::string& name) {
    expect({"key", name});
}

cv::Size Display::size() {
    const auto [code, output] = xdotool({"getwindowgeometry", "--shell", window_});
    EXPECT_EQ(code, 0) << output;
    cv::Size size;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("WIDTH=")) size.width = std::stoi(line.substr(6));
        if (line.starts_with("HEIGHT=")) size.height = std::stoi(line.substr(7));
    }
    return size;
}

}  // namespace goalmouth::test
