#include "tests/support/well_formed.h"

#include <regex>
#include <set>
#include <vector>

namespace goalmouth::test {
namespace {

bool is_void(const std::string& name) {
    static const std::set<std::string> names{"meta", "img", "br", "hr", "link", "input"};
    return names.count(name) > 0;
}

/// The end of the tag that begins at `i`, quotes skipped; npos where it does not end.
std::size_t end_of_tag(const std::string& text, std::size_t i) {
    char quote = 0;
    for (; i < text.size(); ++i) {
        const char c = text[i];
        if (quote != 0) {
            if (c == quote) quote = 0;
            if (c == '<') return std::string::npos;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '>') {
            return i;
        }
    }
    return std::string::npos;
}

}  // namespace

std::string fault_in_markup(const std::string& text) {
    std::vector<std::string> open;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '&') {
            static const std::regex reference("^&(#[0-9]+|#x[0-9a-fA-F]+|[a-z]+);");
            const std::string here = text.substr(i, 12);
            if (!std::regex_search(here, reference)) return "a bare ampersand: " + text.substr(i, 40);
        }
        if (text[i] != '<') continue;
        const std::size_t end = end_of_tag(text, i);
        if (end == std::string::npos) return "a tag without an end: " + text.substr(i, 60);
        const std::string tag = text.substr(i + 1, end - i - 1);
        i = end;
        if (tag.empty() || tag.front() == '!' || tag.front() == '?') continue;
        const bool closes = tag.front() == '/';
        const std::size_t begin = closes ? 1 : 0;
        const std::string name = tag.substr(begin, tag.find_first_of(" \n\t/", begin) - begin);
        if (closes) {
            if (open.empty() || open.back() != name)
                return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
            open.pop_back();
        } else if (tag.back() != '/' && !is_void(name)) {
            open.push_back(name);
        }
        if (name == "style" && !closes) i = text.find("</style>", i) - 1;
    }
    return open.empty() ? "" : "<" + open.back() + "> is not closed";
}

std::string repeated_id(const std::string& html) {
    static const std::regex ids(R"(\sid=['"]([^'"]+)['"])");
    std::set<std::string> seen;
    for (auto it = std::sregex_iterator(html.begin(), html.end(), ids); it != std::sregex_iterator(); ++it) {
        if (!seen.insert((*it)[1]).second) return (*it)[1];
    }
    return "";
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t i = text.find(part); i != std::string::npos; i = text.find(part, i + part.size())) ++n;
    return n;
}

}  // namespace goalmouth::test
