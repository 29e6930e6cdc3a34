#pragma once

#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

// How a plain struct of parameters describes itself, once, for everything that loads, checks, prints and
// documents it.
//
// A struct with parameters has, beside it, a function template
//
//     template <class Visitor>
//     void describe_parameters(Visitor& v, RansacParameters& p) {
//         v("attempts", p.attempts, Range{1, 100000}, "1", "hypotheses drawn for each line");  // int
//         v("spacing", p.spacing, Choice{"image", "field"}, "where scan-lines are even");  // std::string
//         v("table", p.table, File{}, "colour table");                // std::string
//         v("mirrored", p.mirrored, "the camera hangs upside down");  // bool
//         v("robot", p.robot, Text{}, "name shown to people");        // std::string
//         v("offsets", p.offsets, Range{-1, 1}, "m", "…");            // std::vector<double>
//         v.group("walk", p.walk, "how the robot walks");             // a struct described likewise
//     }
//
// and nothing else: this header is all a stage needs to know. core/process/configuration.h reads such a
// struct from YAML.
namespace goalmouth {

/// Inclusive bounds of a number. Use `at_least` and `above` where one side is open; NaN never fits.
struct Range {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
};

inline Range at_least(double lowest) {
    return {lowest, std::numeric_limits<double>::infinity()};
}
inline Range above(double bound) {
    return {std::nextafter(bound, std::numeric_limits<double>::infinity()),
            std::numeric_limits<double>::infinity()};
}

/// The words a text parameter may be.
struct Choice {
    std::vector<std::string> words;
    Choice(std::initializer_list<const char*> list) : words(list.begin(), list.end()) {}
};

/// A text parameter that names a file; a relative path counts from the file it stands in.
/// `may_be_empty`: "" means none.
struct File {
    bool may_be_empty = false;
};

/// A text parameter without further rules.
struct Text {};

}  // namespace goalmouth
