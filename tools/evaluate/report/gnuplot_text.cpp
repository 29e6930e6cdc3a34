#include "tools/evaluate/report/gnuplot_text.h"

#include "tools/evaluate/report/clean_text.h"

#include <algorithm>

namespace goalmouth {

std::string gnuplot_string(const std::string& text) {
    std::string result = "'";
    for (const char c : clean_text(text)) {
        if (c == '\'') {
            result += "''";
        } else if (c == '\n') {
            result += "'.\"\\n\".'";
        } else {
            result += c == '\t' ? ' ' : c;
        }
    }
    return result + "'";
}

std::string one_line(const std::string& text) {
    std::string line = clean_text(text);
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
    return line;
}

}  // namespace goalmouth
