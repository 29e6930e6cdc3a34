#include "core/imaging/colour_gains.h"

#include "core/imaging/clipped_colours.h"
#include "core/imaging/rgb.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace goalmouth {

namespace {

constexpr double coarse_below = 0.7;  // gain: of a darker picture, a cell holds too many colours that were
constexpr int finest_adapted = 7;     // bits: of more, making the table takes longer than a frame

std::uint8_t level(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

LumaChroma undone(const Rgb& rgb, const ColourGains& gains) {
    return luma_chroma_of({rgb.red / gains.red, rgb.green / gains.green, rgb.blue / gains.blue});
}

int adapted_bits(int bits, const ColourGains& gains) {
    const double least = std::min({gains.red, gains.green, gains.blue});
    return least < coarse_below ? std::max(bits, std::min(bits + 1, finest_adapted)) : bits;
}

/// The colours that clip only now. What they would be if they only just reached the end is the complement of
/// the light's colour: white would be yellow in blue light.
void add_clipped(ColourTable& table, const ColourTable& base, const ColourGains& gains) {
    const ClippedColours clipped(base, gains);
    const int step = 1 << (8 - table.bits());
    const double centre = 0.5 * (step - 1);
    std::size_t entry = 0;
    for (int cb = 0; cb < 256; cb += step)
        for (int cr = 0; cr < 256; cr += step)
            for (int y = 0; y < 256; y += step, ++entry)
                if (const auto colour =
                        clipped.at(rgb_of(y + centre, cb + centre - 128.0, cr + centre - 128.0)))
                    table.entries()[entry] = static_cast<std::uint8_t>(*colour);
}

}  // namespace

ColourTable adapted(const ColourTable& base, const ColourGains& gains) {
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
                const Ycbcr was{level(chroma.y + luma.y), level(chroma.cb + luma.cb + 128.0),
                                level(chroma.cr + luma.cr + 128.0)};
                table.entries()[entry++] = static_cast<std::uint8_t>(base.at(was));
            }
        }
    }
    if (std::max({gains.red, gains.green, gains.blue}) > 1.0) add_clipped(table, base, gains);
    return table;
}

}  // namespace goalmouth
