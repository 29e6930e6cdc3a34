#include "core/process/text.h"

#include <algorithm>
#include <numeric>
#include <sstream>

namespace goalmouth {
namespace {

/// Levenshtein distance.
std::size_t edits_between(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0U);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

}  // namespace

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
    if (parts.empty()) parts.emplace_back();
    return parts;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& valid) {
    std::string text;
    const auto nearest = std::min_element(valid.begin(), valid.end(), [&](const auto& a, const auto& b) {
        return edits_between(word, a) < edits_between(word, b);
    });
    if (nearest != valid.end() &&
        edits_between(word, *nearest) <= std::max<std::size_t>(2, word.size() / 3)) {
        text = "did you mean '" + *nearest + "'? ";
    }
    if (valid.empty()) return text + "nothing is valid here";
    text += "valid: ";
    for (std::size_t i = 0; i < valid.size(); ++i) text += (i ? ", " : "") + valid[i];
    return text;
}

}  // namespace goalmouth
