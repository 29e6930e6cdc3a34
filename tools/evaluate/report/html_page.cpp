#include "tools/evaluate/report/html_page.h"

#include "tools/evaluate/report/clean_text.h"
#include "tools/evaluate/report/html_style.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <stdexcept>

namespace goalmouth {
namespace {

/// "Worst failures" → "worst-failures".
std::string anchor_of(const std::string& title) {
    std::string anchor;
    for (const char c : title) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80 && std::isalnum(byte) != 0) {
            anchor += static_cast<char>(std::tolower(byte));
        } else if (!anchor.empty() && anchor.back() != '-') {
            anchor += '-';
        }
    }
    while (!anchor.empty() && anchor.back() == '-') anchor.pop_back();
    return anchor.empty() ? "section" : anchor;
}

std::string caption_html(const std::string& caption) {
    return caption.empty() ? "" : "<figcaption>" + escape_html(caption) + "</figcaption>";
}

std::string image_html(const PagePicture& picture) {
    const std::string hint = picture.hint.empty() ? "" : " title=\"" + escape_html(picture.hint) + "\"";
    return fmt::format("<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\"{}>", picture.uri, picture.width,
                       picture.height, escape_html(picture.caption), hint);
}

std::string picture_html(const PagePicture& picture) {
    return "<figure>" + image_html(picture) + caption_html(picture.caption) + "</figure>\n";
}

/// A ticked box lets the style sheet spread the picture over the window: a page without scripts may not open
/// a picture of its own in another way.
std::string enlargeable_html(const PagePicture& picture) {
    return "<figure><label class=\"zoom\"><input type=\"checkbox\" aria-label=\"Show large\">" +
           image_html(picture) + "</label>" + caption_html(picture.caption) + "</figure>\n";
}

}  // namespace

std::string escape_html(const std::string& text) {
    std::string escaped;
    for (const char c : clean_text(text)) {
        switch (c) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            case '\'':
                escaped += "&#39;";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

HtmlPage::HtmlPage(std::string title, std::string lead) : title_(std::move(title)), lead_(std::move(lead)) {}

HtmlPage& HtmlPage::section(const std::string& title, const std::string& anchor) {
    if (inside_details_) throw std::logic_error("a section inside details: " + title);
    const std::string wanted = anchor_of(anchor.empty() ? title : anchor);
    std::string unique = wanted;
    const auto taken = [&](const Entry& entry) { return entry.anchor == unique; };
    for (int n = 2; std::any_of(contents_.begin(), contents_.end(), taken); ++n)
        unique = fmt::format("{}-{}", wanted, n);
    contents_.push_back({unique, title});
    body_ += fmt::format("<h2 id=\"{}\">{}</h2>\n", unique, escape_html(title));
    return *this;
}

HtmlPage& HtmlPage::subsection(const std::string& title) {
    body_ += "<h3>" + escape_html(title) + "</h3>\n";
    return *this;
}

HtmlPage& HtmlPage::paragraph(const std::string& text) {
    body_ += "<p>" + escape_html(text) + "</p>\n";
    return *this;
}

HtmlPage& HtmlPage::note(const std::string& text) {
    body_ += "<p class=\"note\">" + escape_html(text) + "</p>\n";
    return *this;
}

HtmlPage& HtmlPage::list(const std::vector<std::string>& items) {
    if (items.empty()) return *this;
    body_ += "<ul>\n";
    for (const std::string& item : items) body_ += "<li>" + escape_html(item) + "</li>\n";
    body_ += "</ul>\n";
    return *this;
}

HtmlPage& HtmlPage::definitions(const std::vector<std::pair<std::string, std::string>>& entries) {
    if (entries.empty()) return *this;
    body_ += "<dl>\n";
    for (const auto& [term, meaning] : entries)
        body_ += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape_html(term), escape_html(meaning));
    body_ += "</dl>\n";
    return *this;
}

HtmlPage& HtmlPage::code(const std::string& text) {
    body_ += "<pre><code>" + escape_html(text) + "</code></pre>\n";
    return *this;
}

HtmlPage& HtmlPage::table(const Table& table) {
    body_ += table_html(table);
    return *this;
}

HtmlPage& HtmlPage::figure(const DrawnFigure& figure, const std::string& caption) {
    body_ += "<figure>" + figure.inline_svg + caption_html(caption) + "</figure>\n";
    return *this;
}

HtmlPage& HtmlPage::figures(const std::vector<DrawnFigure>& figures, const std::string& caption) {
    body_ += "<figure><div class=\"row\">\n";
    for (const DrawnFigure& figure : figures) body_ += figure.inline_svg + "\n";
    body_ += "</div>" + caption_html(caption) + "</figure>\n";
    return *this;
}

HtmlPage& HtmlPage::picture(const PagePicture& picture) {
    body_ += picture_html(picture);
    return *this;
}

HtmlPage& HtmlPage::pictures(const std::vector<PagePicture>& pictures) {
    body_ += "<div class=\"grid\">\n";
    for (const PagePicture& picture : pictures) body_ += enlargeable_html(picture);
    body_ += "</div>\n";
    return *this;
}

HtmlPage& HtmlPage::details(const std::string& summary, const std::function<void(HtmlPage&)>& fill) {
    HtmlPage inner("", "");
    inner.inside_details_ = true;
    fill(inner);
    body_ += "<details><summary>" + escape_html(summary) + "</summary>\n" + inner.body_ + "</details>\n";
    return *this;
}

std::string HtmlPage::html() const {
    std::string contents;
    for (const Entry& entry : contents_)
        contents += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", entry.anchor, escape_html(entry.title));
    if (contents_.size() > 1)
        contents = "<nav aria-label=\"Contents\"><ol>\n" + contents + "</ol></nav>\n";
    else
        contents.clear();
    const std::string lead = lead_.empty() ? "" : "<p class=\"lead\">" + escape_html(lead_) + "</p>\n";
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n{2}{3}<main>\n{4}</main>\n"
        "</body>\n</html>\n",
        escape_html(title_), html_style(), lead, contents, body_);
}

}  // namespace goalmouth
