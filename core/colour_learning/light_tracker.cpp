#include "core/colour_learning/light_tracker.h"

#include "core/imaging/rgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace goalmouth {

namespace {

constexpr int step = 4;               // px between looked-at pixels
constexpr double below_border = 8.0;  // px: mixed pixels and the rim of the carpet stay out
constexpr double least_level = 8.0;   // a darker channel's ratio is noise
constexpr double saturated = 250.0;   // a channel that clips says nothing

/// Counts of levels.
class Levels {
  public:
    void add(double level) {
        ++counts_[static_cast<std::size_t>(std::clamp(std::lround(level), 0L, 255L))];
        ++all_;
    }
    double median() const {
        int below = 0;
        std::size_t level = 0;
        while (level < 255 && 2 * (below + counts_[level]) < all_) below += counts_[level++];
        return static_cast<double>(level);
    }

  private:
    std::array<int, 256> counts_{};
    int all_ = 0;
};

}  // namespace

std::optional<FieldLook> look_at_field(YuyvView image, const FieldBorder& border, const ColourTable& table,
                                       const LightTrackerParameters& parameters) {
    if (border.empty()) return std::nullopt;
    std::array<Levels, 3> rgb;
    int all = 0, below = 0, field = 0, taken = 0;
    for (int x = step / 2; x < image.width; x += step) {
        const double from = border.y_at(x) + below_border;
        for (int y = step / 2; y < image.height; y += step) {
            ++all;
            if (y < from) continue;
            ++below;
            const Ycbcr p = image.at(x, y);
            const Colour colour = table.at(p);
            field += colour == Colour::field;
            if (colour != Colour::field && colour != Colour::unclassified) continue;
            ++taken;
            const Rgb levels = rgb_of(p);
            rgb[0].add(levels.red);
            rgb[1].add(levels.green);
            rgb[2].add(levels.blue);
        }
    }
    if (taken == 0 || below < parameters.least_area * all || field < parameters.least_field * below)
        return std::nullopt;
    return FieldLook{{rgb[0].median(), rgb[1].median(), rgb[2].median()}};
}

bool LightTracker::follow(const FieldLook& look, std::int64_t utime) {
    if (!has_reference()) {
        ++looks_;
        reference_ += (look.rgb - reference_) / looks_;
        last_ = utime;
        return false;
    }
    const double elapsed = std::max(0.0, static_cast<double>(utime - last_) * 1e-6);
    const double pull =
        parameters_.time_constant > 0.0 ? 1.0 - std::exp(-elapsed / parameters_.time_constant) : 1.0;
    last_ = std::max(last_, utime);

    const std::array<double*, 3> gains = {&gains_.red, &gains_.green, &gains_.blue};
    std::array<double, 3> wanted{};
    for (int c = 0; c < 3; ++c) {
        const double now = *gains[static_cast<std::size_t>(c)];
        const double ratio = look.rgb[c] / std::max(reference_[c], least_level);
        const bool says_something = reference_[c] >= least_level && look.rgb[c] < saturated;
        wanted[static_cast<std::size_t>(c)] =
            std::clamp(says_something ? ratio : now, parameters_.lowest, parameters_.highest);
        if (std::abs(wanted[static_cast<std::size_t>(c)] - now) > parameters_.largest_step * now) {
            ++disbelieved_;
            return false;
        }
    }
    for (std::size_t c = 0; c < 3; ++c) *gains[c] += pull * (wanted[c] - *gains[c]);
    return true;
}

}  // namespace goalmouth
