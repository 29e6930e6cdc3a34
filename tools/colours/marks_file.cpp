#include "tools/colours/marks_file.h"

#include "core/imaging/file_error.h"
#include "core/imaging/image_file.h"
#include "core/process/configuration.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <iomanip>
#include <sstream>

namespace goalmouth {

namespace {

namespace fs = std::filesystem;

std::string known_classes() {
    std::string names;
    for (const auto name : colour_names) names.append(names.empty() ? "" : ", ").append(name);
    return names;
}

template <class Number>
std::optional<Number> number_of(std::string_view text) {
    Number number{};
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

/// "match.lcmlog@12" is a log's picture; with the name of a picture file it is the file's own name.
MarkedPicture picture_named(const std::string& name, const fs::path& folder) {
    const auto at = name.rfind('@');
    if (at != std::string::npos && !is_image_name(name)) {
        if (const auto place = number_of<std::size_t>(std::string_view(name).substr(at + 1)))
            return {folder / name.substr(0, at), place};
    }
    return {folder / name, std::nullopt};
}

/// Its words, without the remark. Nothing where quotation marks do not close.
std::optional<std::vector<std::string>> words_of(const std::string& text) {
    std::vector<std::string> words;
    std::istringstream in(text);
    while (in >> std::ws && in.peek() != std::char_traits<char>::eof() && in.peek() != '#') {
        std::string word;
        if (in.peek() == '"') {
            in >> std::quoted(word);
            const std::string whole =
                text.substr(0, in.eof() ? text.size() : static_cast<std::size_t>(in.tellg()));
            if (whole.empty() || whole.back() != '"') return std::nullopt;
        } else {
            for (int next = in.peek();
                 next != std::char_traits<char>::eof() && next != '#' && !std::isspace(next);
                 next = in.peek())
                word += static_cast<char>(in.get());
        }
        words.push_back(word);
    }
    return words;
}

class LineReader {
  public:
    LineReader(const std::string& text, const fs::path& file, int line)
        : text_(text), file_(file), line_(line) {}

    MarkLine read(const std::vector<std::string>& words) const {
        if (words.size() < 3) throw no_mark();
        const auto found = std::find(colour_names.begin(), colour_names.end(), words[1]);
        const bool shape = words[2] == "polygon" || words[2] == "fill";
        const std::vector<int> numbers = numbers_of({words.begin() + (shape ? 3 : 2), words.end()});
        MarkLine mark{picture_named(words[0], file_.parent_path()), Colour::unclassified,
                      !shape                  ? MarkShape(box(numbers))
                      : words[2] == "polygon" ? MarkShape(polygon(numbers))
                                              : MarkShape(fill(numbers)),
                      line_};
        if (found == colour_names.end())
            throw error("unknown class \"" + words[1] + "\"; valid: " + known_classes());
        mark.colour = static_cast<Colour>(found - colour_names.begin());
        return mark;
    }

    ConfigurationError no_mark() const {
        constexpr std::size_t most = 80;
        return error(
            "\"" + (text_.size() > most ? text_.substr(0, most) + "…" : text_) +
            "\" is not PICTURE CLASS X0 Y0 X1 Y1, such as \"1.png goal 507 20 520 180\", nor PICTURE "
            "CLASS polygon X Y X Y X Y …, nor PICTURE CLASS fill X Y TOLERANCE");
    }

  private:
    ConfigurationError error(const std::string& what) const {
        return ConfigurationError(fmt::format("{}:{}: {}", file_.string(), line_, what));
    }

    std::vector<int> numbers_of(const std::vector<std::string>& words) const {
        constexpr int largest = 1 << 20;  // px, larger than any picture
        std::vector<int> numbers;
        for (const std::string& word : words) {
            const auto number = number_of<long long>(word);
            if (!number) throw no_mark();
            if (*number < 0 || *number > largest)
                throw error(word +
                            " is no place in a picture: 0 0 is its first pixel, and none is wider than " +
                            std::to_string(largest));
            numbers.push_back(static_cast<int>(*number));
        }
        return numbers;
    }

    MarkedBox box(const std::vector<int>& n) const {
        if (n.size() != 4) throw no_mark();
        if (n[2] < n[0] || n[3] < n[1])
            throw error(
                "a box runs from its upper left corner to its lower right one, 0 0 being the picture's first "
                "pixel");
        return {cv::Rect(cv::Point(n[0], n[1]), cv::Point(n[2] + 1, n[3] + 1))};
    }
    MarkedPolygon polygon(const std::vector<int>& n) const {
        if (n.size() < 6 || n.size() % 2 != 0) throw no_mark();
        MarkedPolygon polygon;
        for (std::size_t i = 0; i < n.size(); i += 2) polygon.corners.emplace_back(n[i], n[i + 1]);
        return polygon;
    }
    MarkedFill fill(const std::vector<int>& n) const {
        if (n.size() != 3) throw no_mark();
        return {{n[0], n[1]}, n[2]};
    }

    const std::string& text_;
    const fs::path& file_;
    int line_;
};

struct ShapeText {
    std::string operator()(const MarkedBox& b) const {
        return fmt::format("{} {} {} {}", b.box.x, b.box.y, b.box.br().x - 1, b.box.br().y - 1);
    }
    std::string operator()(const MarkedPolygon& polygon) const {
        std::string text = "polygon";
        for (const cv::Point p : polygon.corners) text += fmt::format(" {} {}", p.x, p.y);
        return text;
    }
    std::string operator()(const MarkedFill& f) const {
        return fmt::format("fill {} {} {}", f.seed.x, f.seed.y, f.tolerance);
    }
};

std::string name_of(const MarkedPicture& picture, const fs::path& folder) {
    std::error_code problem;
    // A link stays one: what it leads to may have a name that says nothing.
    const fs::path absolute = fs::absolute(picture.file);
    fs::path near = fs::relative(absolute.parent_path(), folder.empty() ? "." : folder, problem);
    if (!problem && !near.empty()) near = (near / absolute.filename()).lexically_normal();
    std::string name = problem || near.empty() ? absolute.string() : near.string();
    if (picture.place) name += "@" + std::to_string(*picture.place);
    if (name.find_first_of("\r\n") != std::string::npos)
        throw ConfigurationError(picture.file.string() +
                                 ": a name with a line's end in it cannot stand in a file of marks");
    if (name.find_first_of(" \t\v\f#\"") == std::string::npos) return name;
    std::ostringstream out;
    out << std::quoted(name);
    return out.str();
}

}  // namespace

std::vector<MarkLine> read_marks(const fs::path& file) {
    constexpr std::uintmax_t largest = 1 << 24;  // bytes: tens of thousands of marks
    std::error_code problem;
    if (const auto size = fs::file_size(file, problem); !problem && size > largest)
        throw ConfigurationError(file.string() + ": too large to be a file of marks");
    std::vector<std::uint8_t> bytes;
    try {
        bytes = read_bytes(file);
    } catch (const FileError& error) {
        throw ConfigurationError(error.what());
    }
    if (std::find(bytes.begin(), bytes.end(), std::uint8_t{0}) != bytes.end())
        throw ConfigurationError(file.string() + ": no text, so no file of marks");
    std::istringstream lines(std::string(bytes.begin(), bytes.end()));
    std::vector<MarkLine> marks;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (line.ends_with('\r')) line.pop_back();
        const LineReader reader(line, file, number);
        const auto words = words_of(line);
        if (!words) throw reader.no_mark();
        if (!words->empty()) marks.push_back(reader.read(*words));
    }
    if (marks.empty())
        throw ConfigurationError(file.string() +
                                 ": holds no box or other mark; a line is PICTURE CLASS X0 Y0 X1 Y1");
    return marks;
}

std::string marks_text(const std::vector<MarkLine>& marks, const fs::path& folder) {
    std::string text = "# PICTURE CLASS X0 Y0 X1 Y1 | polygon X Y … | fill X Y TOLERANCE, in px\n";
    for (const MarkLine& mark : marks)
        text += fmt::format("{} {} {}\n", name_of(mark.picture, folder),
                            colour_names[static_cast<std::size_t>(mark.colour)],
                            std::visit(ShapeText{}, mark.shape));
    return text;
}

}  // namespace goalmouth
