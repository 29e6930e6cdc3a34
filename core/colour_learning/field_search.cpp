#include "core/colour_learning/field_search.h"

#include "core/colour_learning/level_counts.h"
#include "core/colour_learning/same_surface.h"
#include "core/imaging/rgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace goalmouth {

namespace {

constexpr int columns = 64;       // looked at, and rows as far apart
constexpr double darkest = 0.15;  // brightness that is tried, over the reference's
constexpr double brightest = 6.0;
constexpr double brightness_ratio = 1.15;  // between those tried
constexpr double warmest = 0.6;            // ln of red over green
constexpr double warmth_step = 0.1;
// From 2700 to 7500 K, blue over green changes about twice as much as red over green, the other way round (in
// logarithms; black bodies, BT.709 primaries).
constexpr double blue_to_red = -2.0;
constexpr double least_luma = 12.0;    // levels; in the dark all colours are noise
constexpr double least_chroma = 0.12;  // of luma; a duller colour may be a wall's

struct Sample {
    Rgb rgb;
    LumaChroma colour;
};

std::vector<Sample> lower_half(YuyvView image) {
    const int step = std::max(1, image.width / columns);
    std::vector<Sample> samples;
    for (int y = image.height / 2; y < image.height; y += step) {
        for (int x = step / 2; x < image.width; x += step) {
            const Ycbcr p = image.at(x, y);
            samples.push_back({rgb_of(p), {static_cast<double>(p.y), p.cb - 128.0, p.cr - 128.0}});
        }
    }
    return samples;
}

FieldLook look_of(const std::vector<Sample>& samples, const LumaChroma& colour) {
    std::array<LevelCounts, 3> rgb;
    for (const Sample& sample : samples) {
        if (!same_surface(sample.colour, colour)) continue;
        rgb[0].add(sample.rgb.red);
        rgb[1].add(sample.rgb.green);
        rgb[2].add(sample.rgb.blue);
    }
    return {{rgb[0].median(), rgb[1].median(), rgb[2].median()}};
}

}  // namespace

std::optional<FieldLook> search_field(YuyvView image, const Eigen::Vector3d& reference,
                                      const LightTrackerParameters& parameters) {
    const std::vector<Sample> samples = lower_half(image);
    auto most = static_cast<std::ptrdiff_t>(parameters.least_field * static_cast<double>(samples.size()));
    std::optional<LumaChroma> best;
    const auto shown = [](double level) { return std::min(level, 255.0); };
    for (double brightness = darkest; brightness <= brightest; brightness *= brightness_ratio) {
        for (double warmth = -warmest; warmth <= warmest; warmth += warmth_step) {
            const LumaChroma colour = luma_chroma_of(
                {shown(brightness * std::exp(warmth) * reference.x()), shown(brightness * reference.y()),
                 shown(brightness * std::exp(blue_to_red * warmth) * reference.z())});
            if (colour.y < least_luma || std::hypot(colour.cb, colour.cr) < least_chroma * colour.y) continue;
            const auto count = std::count_if(samples.begin(), samples.end(),
                                             [&](const Sample& s) { return same_surface(s.colour, colour); });
            if (count <= most) continue;
            most = count;
            best = colour;
        }
    }
    if (!best) return std::nullopt;
    return look_of(samples, *best);
}

}  // namespace goalmouth
