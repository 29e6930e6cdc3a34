#include "core/imaging/colour_rules.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace goalmouth {

ChromaPolar chroma_polar(Ycbcr colour) {
    return chroma_polar(colour.y, colour.cb - 128.0, colour.cr - 128.0);
}

ChromaPolar chroma_polar(double luma, double cb, double cr) {
    ChromaPolar polar;
    polar.luma = luma;
    polar.chroma = std::hypot(cb, cr);
    polar.hue = std::atan2(cr, cb) * 180.0 / std::numbers::pi;
    if (polar.hue < 0.0) polar.hue += 360.0;
    polar.saturation = polar.chroma / std::max(polar.luma, 1.0);
    return polar;
}

bool ColourRule::fits(Ycbcr p) const {
    const ChromaPolar polar = chroma_polar(p);
    const bool hue_fits = hue.lowest <= hue.highest ? hue.holds(polar.hue)
                                                    : polar.hue >= hue.lowest || polar.hue <= hue.highest;
    return hue_fits && y.holds(p.y) && cb.holds(p.cb) && cr.holds(p.cr) && chroma.holds(polar.chroma) &&
           saturation.holds(polar.saturation);
}

ColourTable table_from_rules(std::span<const ColourRule> rules, int bits, const std::string& name) {
    ColourTable table(bits, name);
    const int step = 1 << (8 - bits);
    for (int cb = 0; cb < 256; cb += step) {
        for (int cr = 0; cr < 256; cr += step) {
            for (int y = 0; y < 256; y += step) {
                const Ycbcr p = cell_centre({static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(cb),
                                             static_cast<std::uint8_t>(cr)},
                                            bits);
                const auto rule =
                    std::find_if(rules.begin(), rules.end(), [p](const ColourRule& r) { return r.fits(p); });
                if (rule != rules.end()) table.set(p, rule->colour);
            }
        }
    }
    return table;
}

}  // namespace goalmouth
