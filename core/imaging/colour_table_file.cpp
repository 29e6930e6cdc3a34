#include "core/imaging/colour_table_file.h"

#include "core/imaging/file_error.h"
#include "core/imaging/image_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

namespace goalmouth {

namespace {

constexpr std::string_view magic = "goalmouth colour table 1";
constexpr std::size_t longest_header =
    65536;  // bytes; a file without an end of its header is refused, not searched through

struct Header {
    std::string name;
    std::optional<int> bits;
    std::vector<std::string> provenance;
    std::vector<std::uint8_t> classes;  // class of each number used in the entries
    std::size_t end = 0;                // where the entries begin
};

[[noreturn]] void fail(const std::string& file, const std::string& what) {
    throw FileError(file + ": " + what);
}

/// A name or a note of several lines would end the header early.
std::string on_one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

std::vector<std::uint8_t> parse_classes(const std::string& file, int line, const std::string& value) {
    std::vector<std::uint8_t> classes;
    std::istringstream words(value);
    for (std::string word; words >> word;) {
        const auto found = std::find(colour_names.begin(), colour_names.end(), word);
        if (found == colour_names.end()) {
            std::string known;
            for (const auto name : colour_names) known.append(1, ' ').append(name);
            fail(file,
                 "line " + std::to_string(line) + ": unknown class \"" + word + "\"; classes are:" + known);
        }
        classes.push_back(static_cast<std::uint8_t>(found - colour_names.begin()));
    }
    if (classes.empty()) fail(file, "line " + std::to_string(line) + ": names no class");
    return classes;
}

int parse_bits(const std::string& file, int line, const std::string& value) {
    int bits = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), bits);
    if (error != std::errc() || end != value.data() + value.size() || bits < 5 || bits > 8)
        fail(file, "line " + std::to_string(line) + ": bits must be 5, 6, 7 or 8, not \"" + value + "\"");
    return bits;
}

Header parse_header(std::span<const std::uint8_t> bytes, const std::string& file) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                                std::min(bytes.size(), longest_header));
    if (!text.starts_with(magic)) {
        fail(file, "is not a colour table of ours: it does not begin with \"" + std::string(magic) +
                       "\" (tables of other teams: goalmouth colours import)");
    }
    Header header;
    std::size_t at = 0;
    for (int line = 1;; ++line) {
        const std::size_t end = text.find('\n', at);
        if (end == std::string_view::npos) fail(file, "is cut off in its header: no line \"data\"");
        const std::string content(text.substr(at, end - at));
        at = end + 1;
        if (line == 1) {
            if (content != magic)
                fail(file, "line 1: found \"" + content + "\", expected \"" + std::string(magic) + "\"");
            continue;
        }
        if (content == "data") break;
        const std::size_t colon = content.find(": ");
        const std::string key = content.substr(0, colon);
        const std::string value = colon == std::string::npos ? "" : content.substr(colon + 2);
        if (key == "name")
            header.name = value;
        else if (key == "bits")
            header.bits = parse_bits(file, line, value);
        else if (key == "made")
            header.provenance.push_back(value);
        else if (key == "classes")
            header.classes = parse_classes(file, line, value);
        else if (key == "order") {
            if (value != "cb cr y")
                fail(file, "line " + std::to_string(line) + ": the order must be \"cb cr y\", not \"" +
                               value + "\"");
        } else {
            fail(file, "line " + std::to_string(line) + ": unknown key \"" + key +
                           "\"; known: name, bits, order, classes, made, data");
        }
    }
    if (!header.bits) fail(file, "its header has no line \"bits: N\"");
    if (header.classes.empty()) fail(file, "its header has no line \"classes: …\"");
    header.end = at;
    return header;
}

std::string described(Ycbcr p) {
    return "Y " + std::to_string(p.y) + ", Cb " + std::to_string(p.cb) + ", Cr " + std::to_string(p.cr);
}

Colour from_nubots(std::uint8_t value, bool& known) {
    known = true;
    switch (value) {
        case 0:
            return Colour::unclassified;
        case 1:
            return Colour::line;
        case 2:
            return Colour::field;
        case 6:
            return Colour::ball;
        case 8:
            return Colour::goal;
        case 9:
            return Colour::unclassified;
        default:
            known = false;
            return Colour::unclassified;
    }
}

Colour from_gmu(std::uint8_t value, bool& known) {
    known = value < 32;
    if (value & 1) return Colour::ball;
    if (value & 2) return Colour::goal;
    if (value & 16) return Colour::line;
    if (value & 8) return Colour::field;
    return Colour::unclassified;
}

struct Foreign {
    std::string_view name;
    int bits;
    Colour (*colour)(std::uint8_t, bool&);
    std::string_view values;
};

const Foreign& foreign(ForeignFormat format) {
    static constexpr Foreign nubots{"nubots_2013", 7, from_nubots, "0, 1, 2, 6, 8 and 9"};
    static constexpr Foreign gmu{"gmu_2014", 6, from_gmu, "sums of the bits 1, 2, 4, 8 and 16"};
    return format == ForeignFormat::nubots_2013 ? nubots : gmu;
}

}  // namespace

ColourTable parse_colour_table(std::span<const std::uint8_t> bytes, const std::string& name) {
    const Header header = parse_header(bytes, name);
    ColourTable table(*header.bits, header.name);
    for (const std::string& line : header.provenance) table.add_provenance(line);
    const std::span<const std::uint8_t> entries = bytes.subspan(header.end);
    if (entries.size() != table.entries().size()) {
        fail(name, std::string(entries.size() < table.entries().size() ? "is cut off" : "is too long") +
                       ": " + std::to_string(entries.size()) + " entries follow the header, " +
                       std::to_string(*header.bits) + " bits an axis make " +
                       std::to_string(table.entries().size()));
    }
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (entries[i] >= header.classes.size()) {
            fail(name, "entry " + std::to_string(i) + " is " + std::to_string(entries[i]) +
                           ", but the header names " + std::to_string(header.classes.size()) +
                           " classes, numbered from 0");
        }
        table.entries()[i] = header.classes[entries[i]];
    }
    return table;
}

std::vector<std::uint8_t> serialise(const ColourTable& table) {
    std::string header = std::string(magic) + "\nname: " + on_one_line(table.name()) +
                         "\nbits: " + std::to_string(table.bits()) + "\norder: cb cr y\nclasses:";
    for (const auto name : colour_names) header.append(1, ' ').append(name);
    header += "\n";
    for (const std::string& line : table.provenance()) header += "made: " + on_one_line(line) + "\n";
    header += "data\n";
    std::vector<std::uint8_t> bytes(header.begin(), header.end());
    bytes.insert(bytes.end(), table.entries().begin(), table.entries().end());
    return bytes;
}

ColourTable load_colour_table(const std::filesystem::path& file) {
    return parse_colour_table(read_bytes(file), file.string());
}

void save_colour_table(const ColourTable& table, const std::filesystem::path& file) {
    write_bytes(file, serialise(table));
}

std::vector<std::string> foreign_format_names() {
    return {std::string(foreign(ForeignFormat::nubots_2013).name),
            std::string(foreign(ForeignFormat::gmu_2014).name)};
}

std::optional<ForeignFormat> foreign_format(std::string_view name) {
    for (const ForeignFormat format : {ForeignFormat::nubots_2013, ForeignFormat::gmu_2014})
        if (foreign(format).name == name) return format;
    return std::nullopt;
}

ColourTable import_colour_table(ForeignFormat format, const std::filesystem::path& file) {
    const Foreign& kind = foreign(format);
    const std::vector<std::uint8_t> bytes = read_bytes(file);
    ColourTable table(kind.bits, file.stem().string());
    if (bytes.size() != table.entries().size()) {
        fail(file.string(), "holds " + std::to_string(bytes.size()) + " bytes, but a table of format " +
                                std::string(kind.name) + " has " + std::to_string(table.entries().size()));
    }
    table.add_provenance("imported from " + file.filename().string() + ", format " + std::string(kind.name));
    const int shift = 8 - kind.bits;
    const std::size_t mask = (std::size_t{1} << kind.bits) - 1;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const Ycbcr p{static_cast<std::uint8_t>((i >> (2 * kind.bits)) << shift),
                      static_cast<std::uint8_t>(((i >> kind.bits) & mask) << shift),
                      static_cast<std::uint8_t>((i & mask) << shift)};
        bool known = false;
        const Colour colour = kind.colour(bytes[i], known);
        if (!known) {
            fail(file.string(), "the entry for " + described(p) + " is " + std::to_string(bytes[i]) +
                                    "; format " + std::string(kind.name) + " knows " +
                                    std::string(kind.values));
        }
        table.set(p, colour);
    }
    return table;
}

}  // namespace goalmouth
