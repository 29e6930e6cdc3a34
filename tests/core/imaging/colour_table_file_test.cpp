#include "core/imaging/colour_table_file.h"

#include "core/imaging/colour_rules.h"
#include "core/imaging/file_error.h"
#include "core/imaging/image_file.h"
#include "tests/support/data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace goalmouth {
namespace {

using testing::HasSubstr;

template <class F>
std::string error_of(F f) {
    try {
        f();
    } catch (const FileError& error) {
        return error.what();
    }
    return "no error";
}

std::string parse_error(std::string text, std::size_t entries = 0, char value = 0) {
    text.append(entries, value);
    return error_of([&] {
        parse_colour_table({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "t.gmct");
    });
}

const std::string header5 = "goalmouth colour table 1\nname: t\nbits: 5\nclasses: unclassified goal\ndata\n";
constexpr std::size_t entries5 = 32 * 32 * 32;

TEST(ColourTableFile, KeepsEverything) {
    const test::TemporaryFolder folder;
    for (int bits = 5; bits <= 8; ++bits) {
        ColourTable table(bits, "evening light");
        table.set({200, 60, 150}, Colour::goal);
        table.set({10, 250, 3}, Colour::robot);
        table.add_provenance("first line");
        table.add_provenance("second: line");
        const auto file = folder.path() / "t.gmct";
        save_colour_table(table, file);
        const ColourTable loaded = load_colour_table(file);
        EXPECT_EQ(loaded, table);
        EXPECT_EQ(loaded.name(), "evening light");
        EXPECT_EQ(loaded.provenance(), table.provenance());
    }
}

TEST(ColourTableFile, ANameOfSeveralLinesDoesNotBreakTheHeader) {
    const ColourTable table(5, "a\ndata\nb");
    EXPECT_EQ(parse_colour_table(serialise(table), "t").name(), "a data b");
}

TEST(ColourTableFile, MapsClassesByName) {
    std::string text = header5;
    text.append(entries5, '\1');
    const ColourTable table =
        parse_colour_table({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "t");
    EXPECT_EQ(table.at({1, 2, 3}), Colour::goal);
}

TEST(ColourTableFile, SaysWhatIsWrong) {
    EXPECT_EQ(parse_error(header5, entries5), "no error");
    EXPECT_THAT(parse_error("GIF89a"), HasSubstr("not a colour table"));
    EXPECT_THAT(parse_error(header5, entries5 - 1),
                HasSubstr("cut off: 32767 entries follow the header, 5 bits an axis make 32768"));
    EXPECT_THAT(parse_error(header5, entries5 + 1), HasSubstr("too long"));
    EXPECT_THAT(parse_error(header5, entries5, '\2'), HasSubstr("entry 0 is 2"));
    EXPECT_THAT(parse_error("goalmouth colour table 1\nbits: 9\n"),
                HasSubstr("line 2: bits must be 5, 6, 7 or 8, not \"9\""));
    EXPECT_THAT(parse_error("goalmouth colour table 1\nclasses: goal sky\n"),
                HasSubstr("unknown class \"sky\""));
    EXPECT_THAT(parse_error("goalmouth colour table 1\nclasses: \n"), HasSubstr("names no class"));
    EXPECT_THAT(parse_error("goalmouth colour table 1\ncolour: red\n"),
                HasSubstr("line 2: unknown key \"colour\""));
    EXPECT_THAT(parse_error("goalmouth colour table 1\norder: y cb cr\n"), HasSubstr("order"));
    EXPECT_THAT(parse_error("goalmouth colour table 1\nbits: 5\ndata\n", entries5), HasSubstr("classes"));
    EXPECT_THAT(parse_error("goalmouth colour table 1\nclasses: goal\ndata\n", entries5), HasSubstr("bits"));
    EXPECT_THAT(parse_error("goalmouth colour table 1\nname: no end of header"), HasSubstr("header"));
    EXPECT_THAT(parse_error("goalmouth colour table 12\n"), HasSubstr("line 1"));
}

TEST(ColourTableFile, MissingAndEmptyFilesAreNamed) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(error_of([&] { load_colour_table(folder.path() / "no.gmct"); }),
                HasSubstr("no.gmct: no such file"));
    write_bytes(folder.path() / "empty.gmct", {});
    EXPECT_THAT(error_of([&] { load_colour_table(folder.path() / "empty.gmct"); }), HasSubstr("0 bytes"));
}

TEST(ColourTableFile, SurvivesEveryCut) {
    const std::vector<std::uint8_t> whole = serialise(ColourTable(5, "t"));
    for (std::size_t size = 0; size < whole.size(); size += size < 200 ? 1 : 4001)
        EXPECT_THROW(parse_colour_table(std::span(whole).first(size), "t"), FileError) << size;
}

TEST(ForeignTables, GmuBitsBecomeTheRarestClass) {
    const test::TemporaryFolder folder;
    std::vector<std::uint8_t> bytes(262144, 0);
    const auto entry = [](Ycbcr p) {
        return (static_cast<std::size_t>(p.y >> 2) << 12) | (static_cast<std::size_t>(p.cb >> 2) << 6) |
               (p.cr >> 2);
    };
    const std::vector<std::pair<std::uint8_t, Colour>> cases = {
        {0, Colour::unclassified}, {1, Colour::ball},  {2, Colour::goal},     {4, Colour::unclassified},
        {8, Colour::field},        {16, Colour::line}, {3, Colour::ball},     {2 | 8, Colour::goal},
        {8 | 16, Colour::line},    {31, Colour::ball}, {4 | 8, Colour::field}};
    for (std::size_t i = 0; i < cases.size(); ++i)
        bytes[entry({static_cast<std::uint8_t>(8 * i), 40, 200})] = cases[i].first;
    const auto file = folder.path() / "t.raw";
    write_bytes(file, bytes);
    const ColourTable table = import_colour_table(ForeignFormat::gmu_2014, file);
    EXPECT_EQ(table.bits(), 6);
    EXPECT_EQ(table.name(), "t");
    for (std::size_t i = 0; i < cases.size(); ++i)
        EXPECT_EQ(table.at({static_cast<std::uint8_t>(8 * i), 40, 200}), cases[i].second)
            << int{cases[i].first};

    bytes[5] = 32;
    write_bytes(file, bytes);
    EXPECT_THAT(error_of([&] { import_colour_table(ForeignFormat::gmu_2014, file); }), HasSubstr("is 32"));
}

TEST(ForeignTables, NubotsNumbersAreTranslated) {
    const test::TemporaryFolder folder;
    std::vector<std::uint8_t> bytes(2097152, 0);
    const auto entry = [](Ycbcr p) {
        return (static_cast<std::size_t>(p.y >> 1) << 14) | (static_cast<std::size_t>(p.cb >> 1) << 7) |
               (p.cr >> 1);
    };
    bytes[entry({100, 20, 30})] = 1;
    bytes[entry({110, 20, 30})] = 2;
    bytes[entry({120, 20, 30})] = 6;
    bytes[entry({130, 20, 30})] = 8;
    bytes[entry({140, 20, 30})] = 9;
    const auto file = folder.path() / "t.lut";
    write_bytes(file, bytes);
    const ColourTable table = import_colour_table(ForeignFormat::nubots_2013, file);
    EXPECT_EQ(table.bits(), 7);
    EXPECT_EQ(table.at({100, 20, 30}), Colour::line);
    EXPECT_EQ(table.at({110, 20, 30}), Colour::field);
    EXPECT_EQ(table.at({120, 20, 30}), Colour::ball);
    EXPECT_EQ(table.at({130, 20, 30}), Colour::goal);
    EXPECT_EQ(table.at({140, 20, 30}), Colour::unclassified);

    bytes[entry({100, 20, 30})] = 7;
    write_bytes(file, bytes);
    EXPECT_THAT(error_of([&] { import_colour_table(ForeignFormat::nubots_2013, file); }),
                HasSubstr("Y 100, Cb 20, Cr 30 is 7"));
}

TEST(ForeignTables, AWrongSizeIsNamed) {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "t.lut";
    write_bytes(file, std::vector<std::uint8_t>(1000, 0));
    const std::string error = error_of([&] { import_colour_table(ForeignFormat::nubots_2013, file); });
    EXPECT_THAT(error, HasSubstr("1000 bytes"));
    EXPECT_THAT(error, HasSubstr("2097152"));
}

/// Share of the pixels of one class inside a box of an image.
double share(const YuyvImage& image, const ColourTable& table, cv::Rect box, Colour colour) {
    int count = 0;
    for (int y = box.y; y < box.y + box.height; ++y)
        for (int x = box.x; x < box.x + box.width; ++x) count += table.at(image.view().at(x, y)) == colour;
    return static_cast<double>(count) / box.area();
}

/// Hue of the mean colour of a class's entries.
double mean_hue(const ColourTable& table, Colour colour) {
    const int step = 1 << (8 - table.bits());
    double cb_sum = 0.0;
    double cr_sum = 0.0;
    int count = 0;
    for (int cb = 0; cb < 256; cb += step)
        for (int cr = 0; cr < 256; cr += step)
            for (int y = 0; y < 256; y += step) {
                const Ycbcr p{static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(cb),
                              static_cast<std::uint8_t>(cr)};
                if (table.at(p) != colour) continue;
                cb_sum += cb;
                cr_sum += cr;
                ++count;
            }
    return chroma_polar({128, static_cast<std::uint8_t>(cb_sum / std::max(count, 1)),
                         static_cast<std::uint8_t>(cr_sum / std::max(count, 1))})
        .hue;
}

TEST(ForeignTables, RealOnesHoldOrangeBallsYellowGoalsAndGreenFields) {
    GOALMOUTH_NEEDS_DATA(data);
    const auto tables = data / "colour_tables";
    for (const ColourTable& table :
         {import_colour_table(ForeignFormat::nubots_2013, tables / "nubots_2013/default1.lut"),
          import_colour_table(ForeignFormat::nubots_2013, tables / "nubots_2013/default3.lut"),
          import_colour_table(ForeignFormat::gmu_2014, tables / "gmu_2014/May24th.raw")}) {
        EXPECT_GT(class_counts(table)[static_cast<std::size_t>(Colour::line)], 1000U) << table.name();
        const double ball = mean_hue(table, Colour::ball);
        const double goal = mean_hue(table, Colour::goal);
        const double field = mean_hue(table, Colour::field);
        EXPECT_TRUE(ball > 110 && ball < 145) << table.name() << ": " << ball;
        EXPECT_TRUE(goal > 150 && goal < 195) << table.name() << ": " << goal;
        EXPECT_TRUE(field > 200 && field < 270) << table.name() << ": " << field;
    }
}

TEST(ForeignTables, TheTeamsOwnTableFindsPostAndCarpetInItsFrames) {
    GOALMOUTH_NEEDS_DATA(data);
    const ColourTable may =
        import_colour_table(ForeignFormat::gmu_2014, data / "colour_tables/gmu_2014/May24th.raw");
    const YuyvImage image = read_image(data / "darwin_op_2014/imLogs003.png");
    EXPECT_GT(share(image, may, {512, 80, 14, 90}, Colour::goal), 0.7);     // the post
    EXPECT_GT(share(image, may, {200, 340, 100, 60}, Colour::field), 0.9);  // carpet
}

}  // namespace
}  // namespace goalmouth
