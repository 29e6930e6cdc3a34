#pragma once

#include "tools/evaluate/report/figure.h"
#include "tools/evaluate/report/html_table.h"

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace goalmouth {

/// A picture inside the page, so that nothing beside the page is needed.
struct PagePicture {
    std::string uri;  // data:image/…;base64,…
    int width = 0;    // px, as it is stored
    int height = 0;
    std::string caption;
    std::string hint = {};  // shown where a mouse rests on it
};

/// Photographs as JPEG, drawings with sharp edges or few pixels as PNG.
enum class PictureFormat { jpeg, png };

/// From a BGR or grey picture of 8 bits. Where it is wider than `widest` it is made smaller, for the page's
/// size: a hundred 640×480 photographs are about 8 MB. Throws std::invalid_argument for an empty or other
/// one.
PagePicture page_picture(const cv::Mat& picture, const std::string& caption,
                         PictureFormat format = PictureFormat::jpeg, int widest = 960);
/// A PNG or JPEG file as it stands. Throws ConfigurationError naming the file.
PagePicture page_picture(const std::filesystem::path& file, const std::string& caption);

/// One self-contained HTML page: a title, sections with a table of contents, and what is in them in the order
/// in which it is added. Nothing is loaded from elsewhere. All text is escaped. Light and dark, on screens of
/// any width and on paper.
class HtmlPage {
  public:
    HtmlPage(std::string title, std::string lead);

    /// A heading that the table of contents names. The anchor is made of the title ("Worst failures" →
    /// #worst-failures) where it is not given.
    HtmlPage& section(const std::string& title, const std::string& anchor = "");
    HtmlPage& subsection(const std::string& title);

    HtmlPage& paragraph(const std::string& text);
    /// Something that falls short or that the reader must know before he trusts a figure.
    HtmlPage& note(const std::string& text);
    HtmlPage& list(const std::vector<std::string>& items);
    /// Terms and what they mean: settings, versions.
    HtmlPage& definitions(const std::vector<std::pair<std::string, std::string>>& entries);
    /// Text in typewriter letters, lines kept: the command that made the page.
    HtmlPage& code(const std::string& text);
    HtmlPage& table(const Table& table);

    HtmlPage& figure(const DrawnFigure& figure, const std::string& caption);
    /// Side by side where there is room.
    HtmlPage& figures(const std::vector<DrawnFigure>& figures, const std::string& caption);
    HtmlPage& picture(const PagePicture& picture);
    /// In a grid, as many beside one another as there is room for; a click shows one as large as the window.
    HtmlPage& pictures(const std::vector<PagePicture>& pictures);

    /// What `fill` adds is folded away below `summary`; it must not begin a section.
    HtmlPage& details(const std::string& summary, const std::function<void(HtmlPage&)>& fill);

    /// The whole page, UTF-8.
    std::string html() const;

  private:
    struct Entry {
        std::string anchor;
        std::string title;
    };
    std::string title_;
    std::string lead_;
    std::string body_;
    std::vector<Entry> contents_;
    bool inside_details_ = false;
};

/// `text` as HTML shows it literally, in attributes too; what is no UTF-8 becomes U+FFFD.
std::string escape_html(const std::string& text);

}  // namespace goalmouth
