#include "core/imaging/colour_gains.h"

#include "core/imaging/clipped_colours.h"
#include "core/imaging/rgb.h"
#include "core/imaging/surface_density.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

namespace {

constexpr double coarse_below = 0.7;  // gain: of a darker picture, a cell holds too many colours that were
// Of the density of all colours alike: halls are dull, most other colours never occur, and a post that is
// taken for one of them costs more than one of them taken for a post.
constexpr double odd_weight = 0.1;
constexpr int finest_adapted = 7;  // bits: of more, making the table takes longer than a frame

Rgb rgb_from(const Eigen::Vector3d& levels) {
    return {levels.x(), levels.y(), levels.z()};
}

LumaChroma undone(const Rgb& rgb, const ColourGains& gains) {
    return luma_chroma_of({rgb.red / gains.red, rgb.green / gains.green, rgb.blue / gains.blue});
}

int adapted_bits(int bits, const ColourGains& gains) {
    const double least = std::min({gains.red, gains.green, gains.blue});
    return least < coarse_below ? std::max(bits, std::min(bits + 1, finest_adapted)) : bits;
}

/// Calls `visit` for each entry of the table and the levels in the middle of its cell.
template <class Visit>
void for_each_cell(ColourTable& table, const Visit& visit) {
    const int step = 1 << (8 - table.bits());
    const double centre = 0.5 * (step - 1);
    std::size_t entry = 0;
    for (int cb = 0; cb < 256; cb += step)
        for (int cr = 0; cr < 256; cr += step)
            for (int y = 0; y < 256; y += step, ++entry)
                visit(table.entries()[entry], rgb_of(y + centre, cb + centre - 128.0, cr + centre - 128.0));
}

/// The colours that clip only now. What they would be if they only just reached the end is the complement of
/// the light's colour: white would be yellow in blue light.
void add_clipped(ColourTable& table, const ColourTable& base, const ColourGains& gains) {
    const ClippedColours clipped(base, gains);
    for_each_cell(table, [&](std::uint8_t& entry, const Rgb& seen) {
        if (const auto colour = clipped.at(seen)) entry = static_cast<std::uint8_t>(*colour);
    });
}

/// Whether light has driven a channel to its end that would not reach it without the gains.
bool driven_to_end(const Rgb& seen, const ColourGains& gains) {
    const auto driven = [](double level, double gain) {
        return level >= clipped_level && 255.0 / gain < clipped_level;
    };
    return driven(seen.red, gains.red) || driven(seen.green, gains.green) || driven(seen.blue, gains.blue);
}

/// The field and the posts told from each other and from other things by what they are known to look like.
void decide_known(ColourTable& table, const ColourGains& gains, const KnownColours& known) {
    const SurfaceDensity field = SurfaceDensity::of_colour(*known.field, gains);
    const SurfaceDensity goal = SurfaceDensity::of_colour(*known.goal, gains);
    const SurfaceDensity grey = SurfaceDensity::of_greys(gains);
    const SurfaceDensity anything = SurfaceDensity::of_anything(gains);
    for_each_cell(table, [&](std::uint8_t& entry, const Rgb& seen) {
        const auto was = static_cast<Colour>(entry);
        const bool either = was == Colour::field || was == Colour::goal;
        const bool clips = driven_to_end(seen, gains);
        if (!either && !clips) return;
        const double of_field = field.at(seen), of_goal = goal.at(seen);
        const double of_others = std::max(grey.at(seen), odd_weight * anything.at(seen));
        if (std::max(of_field, of_goal) > of_others)
            entry = static_cast<std::uint8_t>(of_goal > of_field ? Colour::goal : Colour::field);
        else if (was == Colour::goal || (was == Colour::field && clips))
            entry = static_cast<std::uint8_t>(Colour::unclassified);
    });
}

}  // namespace

ColourTable adapted(const ColourTable& base, const ColourGains& gains, const KnownColours& known) {
    if (gains == ColourGains{}) return base;
    ColourTable table(adapted_bits(base.bits(), gains), base.name());
    for (const std::string& line : base.provenance()) table.add_provenance(line);
    const int step = 1 << (8 - table.bits());
    const double centre = 0.5 * (step - 1);
    // What was is linear in what is: the part that luma has in it, and that of chroma, each worked out once.
    std::vector<LumaChroma> of_luma;
    for (int y = 0; y < 256; y += step) of_luma.push_back(undone(rgb_of(y + centre, 0.0, 0.0), gains));
    std::size_t entry = 0;
    for (int cb = 0; cb < 256; cb += step) {
        for (int cr = 0; cr < 256; cr += step) {
            const LumaChroma chroma = undone(rgb_of(0.0, cb + centre - 128.0, cr + centre - 128.0), gains);
            for (const LumaChroma& luma : of_luma) {
                const Ycbcr was =
                    ycbcr_of(LumaChroma{chroma.y + luma.y, chroma.cb + luma.cb, chroma.cr + luma.cr});
                table.entries()[entry++] = static_cast<std::uint8_t>(base.at(was));
            }
        }
    }
    if (std::max({gains.red, gains.green, gains.blue}) > 1.0) add_clipped(table, base, gains);
    if (known.field && known.goal && !is_dull(rgb_from(*known.goal))) decide_known(table, gains, known);
    return table;
}

double goals_kept(const ColourTable& base, const ColourTable& table, const ColourGains& gains,
                  const KnownColours& known) {
    int goal = 0, kept = 0;
    const auto ask = [&](const Eigen::Vector3d& rgb) {
        if (base.at(ycbcr_of(rgb_from(rgb))) != Colour::goal) return;
        ++goal;
        const Eigen::Vector3d seen = rgb.cwiseProduct(Eigen::Vector3d(gains.red, gains.green, gains.blue));
        kept += table.at(ycbcr_of(rgb_from(seen.cwiseMin(255.0)))) == Colour::goal;
    };
    if (known.goal) {
        for (double brightness = 0.6; brightness <= 1.6; brightness *= 1.05) ask(brightness * *known.goal);
    } else {
        constexpr double step = 8.0;  // levels
        for (double red = 0.5 * step; red < 256.0; red += step)
            for (double green = 0.5 * step; green < 256.0; green += step)
                for (double blue = 0.5 * step; blue < 256.0; blue += step) ask({red, green, blue});
    }
    return goal > 0 ? static_cast<double>(kept) / goal : 1.0;
}

}  // namespace goalmouth
