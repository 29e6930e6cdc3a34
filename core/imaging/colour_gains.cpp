#include "core/imaging/colour_gains.h"

#include "core/imaging/rgb.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace goalmouth {

namespace {

std::uint8_t level(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

LumaChroma undone(const Rgb& rgb, const ColourGains& gains) {
    return luma_chroma_of({rgb.red / gains.red, rgb.green / gains.green, rgb.blue / gains.blue});
}

}  // namespace

ColourTable adapted(const ColourTable& base, const ColourGains& gains) {
    if (gains == ColourGains{}) return base;
    ColourTable table(base.bits(), base.name());
    for (const std::string& line : base.provenance()) table.add_provenance(line);
    const int step = 1 << (8 - base.bits());
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
    return table;
}

}  // namespace goalmouth
