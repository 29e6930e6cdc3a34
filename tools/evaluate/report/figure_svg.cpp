#include "tools/evaluate/report/figure_svg.h"

#include "core/process/configuration.h"
#include "tools/evaluate/report/figure_layout.h"
#include "tools/evaluate/report/html_page.h"

#include <fmt/format.h>
#include <regex>

namespace goalmouth {
namespace {

/// The parts of gnuplot's document: the size it names and what is drawn.
struct Drawn {
    std::string width;
    std::string height;
    std::string content;  // between <svg …> and </svg>, without its title and description
};

Drawn parts_of(const std::string& document) {
    const std::size_t root = document.find("<svg");
    const std::size_t inside = root == std::string::npos ? root : document.find('>', root);
    const std::size_t end = document.rfind("</svg>");
    std::smatch size;
    static const std::regex view_box(R"(viewBox="0 0 ([0-9.]+) ([0-9.]+)\")");
    if (inside == std::string::npos || end == std::string::npos || end < inside)
        throw ConfigurationError("gnuplot wrote no SVG");
    const std::string tag = document.substr(root, inside - root);
    if (!std::regex_search(tag, size, view_box))
        throw ConfigurationError("gnuplot wrote an SVG without a size");
    Drawn drawn{size[1], size[2], document.substr(inside + 1, end - inside - 1)};
    // Texts are escaped, so that this finds elements only. Titles within show up when a mouse rests on a
    // curve.
    static const std::regex names("<(title|desc)>[^<]*</(title|desc)>\n?");
    drawn.content = std::regex_replace(drawn.content, names, "");
    static const std::regex font("font-family=\"[^\"]*\"");
    drawn.content = std::regex_replace(
        drawn.content, font, "font-family=\"'DejaVu Sans', Verdana, 'Segoe UI', Roboto, sans-serif\"");
    return drawn;
}

}  // namespace

std::string standalone_svg(const std::string& drawn, const std::string& title) {
    const Drawn parts = parts_of(drawn);
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
        "width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n<title>{2}</title>\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n{3}</svg>\n",
        parts.width, parts.height, escape_html(title), parts.content);
}

std::string inline_svg(const std::string& drawn, const std::string& title, const std::string& stem) {
    const Drawn parts = parts_of(drawn);
    std::string content = parts.content;
    static const std::regex ids(R"(( id=['"])([^'"]+))");
    content = std::regex_replace(content, ids, "$1" + stem + "-$2");
    static const std::regex links(R"(xlink:href='#)");
    content = std::regex_replace(content, links, "href='#" + stem + "-");
    static const std::regex urls(R"(url\(#)");
    content = std::regex_replace(content, urls, "url(#" + stem + "-");

    // Groups name the colour that currentColor means within; without it, that is the page's.
    static const std::regex group_colour(R"((<g [^>]*) color="[^"]*\")");
    content = std::regex_replace(content, group_colour, "$1");
    const auto part = [](std::size_t digit) {
        return std::stoi(std::string(figure_ink).substr(digit, 2), nullptr, 16);
    };
    const std::regex ink(fmt::format(R"(rgb\( *{}, *{}, *{}\))", part(0), part(2), part(4)));
    content = std::regex_replace(content, ink, "currentColor");
    return fmt::format(
        "<svg viewBox=\"0 0 {0} {1}\" style=\"max-width:{0}px\" role=\"img\" aria-label=\"{2}\">{3}</svg>",
        parts.width, parts.height, escape_html(title), content);
}

}  // namespace goalmouth
