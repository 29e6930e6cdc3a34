#pragma once

#include "core/imaging/colour_table.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Colour tables in files: our own format (.gmct, docs/colour_tables.md) and those of two teams whose tables
// we can import. Everything here throws FileError: file, what was found, what was expected.
namespace goalmouth {

ColourTable load_colour_table(const std::filesystem::path& file);
void save_colour_table(const ColourTable& table, const std::filesystem::path& file);

/// The file's content; `name` stands for the file in errors.
ColourTable parse_colour_table(std::span<const std::uint8_t> bytes, const std::string& name);
std::vector<std::uint8_t> serialise(const ColourTable& table);

/// Formats of others.
///   nubots_2013  2 MiB, 7 bits an axis, entry ((Y>>1)<<14) | ((Cb>>1)<<7) | (Cr>>1); class numbers 0
///   unclassified, 1 white, 2 green,
///                6 orange, 8 yellow, 9 blue (blue goals have no class of ours: unclassified)
///   gmu_2014     256 KiB, 6 bits an axis, entry ((Y>>2)<<12) | ((Cb>>2)<<6) | (Cr>>2); bits 1 ball, 2
///   yellow, 4 cyan, 8 field,
///                16 white. An entry with several bits becomes the class that is rarest on a pitch: ball,
///                then goal, then line, then field (a frequent class loses little, a rare one would vanish).
///                Cyan alone is unclassified.
enum class ForeignFormat { nubots_2013, gmu_2014 };

/// "nubots_2013", "gmu_2014".
std::vector<std::string> foreign_format_names();
std::optional<ForeignFormat> foreign_format(std::string_view name);

ColourTable import_colour_table(ForeignFormat format, const std::filesystem::path& file);

}  // namespace goalmouth
