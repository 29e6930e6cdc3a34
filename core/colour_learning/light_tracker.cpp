#include "core/colour_learning/light_tracker.h"

#include "core/colour_learning/level_counts.h"
#include "core/colour_learning/same_surface.h"
#include "core/imaging/rgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace goalmouth {

namespace {

constexpr int step = 4;               // px between looked-at pixels
constexpr double below_border = 8.0;  // px: mixed pixels and the rim of the carpet stay out
constexpr double least_level = 8.0;   // a darker channel's ratio is noise
constexpr double saturated = 250.0;   // a channel that clips says no more than that
constexpr double least_seen = 2.0;  // level: by how much one has fallen that is as good as black nobody knows
constexpr double longest_gap = 1.0;  // s: looks that are farther apart need not be of one light
constexpr int rounds = 3;            // of looking anew around what was found

struct RgbCounts {
    std::array<LevelCounts, 3> channels;
    void add(const Rgb& levels) {
        channels[0].add(levels.red);
        channels[1].add(levels.green);
        channels[2].add(levels.blue);
    }
    Eigen::Vector3d median() const {
        return {channels[0].median(), channels[1].median(), channels[2].median()};
    }
};

/// The median of what may be the surface of colour `start`, and again around that: robots and walls below the
/// border, which the table calls nothing, do not pull at it, and a table that is somewhat wrong by now does
/// not hold it.
Eigen::Vector3d settled(const std::vector<Rgb>& levels, const Eigen::Vector3d& start) {
    Eigen::Vector3d colour = start;
    for (int round = 0; round < rounds; ++round) {
        const LumaChroma around = luma_chroma_of({colour.x(), colour.y(), colour.z()});
        RgbCounts like;
        bool any = false;
        for (const Rgb& rgb : levels) {
            if (!same_surface(luma_chroma_of(rgb), around)) continue;
            like.add(rgb);
            any = true;
        }
        if (!any) break;
        colour = like.median();
    }
    return colour;
}

}  // namespace

std::optional<FieldLook> look_at_field(YuyvView image, const FieldBorder& border, const ColourTable& table,
                                       const LightTrackerParameters& parameters) {
    if (border.empty()) return std::nullopt;
    RgbCounts of_field;
    std::vector<Rgb> taken;
    int all = 0, below = 0, field = 0;
    for (int x = step / 2; x < image.width; x += step) {
        const double from = border.y_at(x) + below_border;
        for (int y = step / 2; y < image.height; y += step) {
            ++all;
            if (y < from) continue;
            ++below;
            const Ycbcr p = image.at(x, y);
            const Colour colour = table.at(p);
            if (colour != Colour::field && colour != Colour::unclassified) continue;
            taken.push_back(rgb_of(p));
            if (colour != Colour::field) continue;
            ++field;
            of_field.add(taken.back());
        }
    }
    if (field == 0 || below < parameters.least_area * all || field < parameters.least_field * below)
        return std::nullopt;
    return FieldLook{settled(taken, of_field.median())};
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
    if (!move(look, pull, parameters_.largest_step)) {
        ++disbelieved_;
        return suspect(look, utime);
    }
    suspected_.reset();
    return true;
}

bool LightTracker::suspect(const FieldLook& look, std::int64_t utime) {
    if (!has_reference()) return false;
    const auto seconds_since = [&](std::int64_t then) { return static_cast<double>(utime - then) * 1e-6; };
    const auto agrees = [&](const Suspicion& s) {
        return (look.rgb.array() <= s.rgb.array() * (1.0 + parameters_.largest_step) + 1.0).all() &&
               (look.rgb.array() >= s.rgb.array() / (1.0 + parameters_.largest_step) - 1.0).all();
    };
    if (!suspected_ || seconds_since(suspected_->last) > std::max(longest_gap, parameters_.jump_after) ||
        !agrees(*suspected_))
        suspected_ = Suspicion{look.rgb, utime, utime};
    suspected_->rgb = look.rgb;
    suspected_->last = utime;
    if (seconds_since(suspected_->first) < parameters_.jump_after) return false;
    suspected_.reset();
    return move(look, 1.0, std::numeric_limits<double>::infinity());
}

bool LightTracker::move(const FieldLook& look, double pull, double largest_step) {
    const std::array<double*, 3> gains = {&gains_.red, &gains_.green, &gains_.blue};
    std::array<double, 3> step{};   // wanted over present gain
    std::array<double, 3> least{};  // of a channel that says nothing else
    std::array<bool, 3> speaks{};
    double sum = 0.0;
    int speaking = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto i = static_cast<Eigen::Index>(c);
        if (reference_[i] < least_level) continue;
        const double seen = std::min(look.rgb[i], saturated) / reference_[i] / *gains[c];
        if (look.rgb[i] >= saturated) {
            least[c] = seen;
            continue;
        }
        speaks[c] = true;
        step[c] = seen;
        if (look.rgb[i] < least_seen) continue;
        sum += std::log(seen);
        ++speaking;
    }
    if (std::none_of(speaks.begin(), speaks.end(), [](bool s) { return s; })) return false;
    const double usual = speaking > 0 ? std::exp(sum / speaking) : 1.0;
    for (std::size_t c = 0; c < 3; ++c) {
        // A channel that says nothing goes with the others, one that clips at least as far as to clip.
        if (!speaks[c]) step[c] = std::max(usual, least[c]);
        step[c] = std::clamp(*gains[c] * step[c], parameters_.lowest, parameters_.highest) / *gains[c];
        if (std::abs(step[c] - 1.0) > largest_step) return false;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        // Once more, for a bit lost in rounding would make a gain that nobody accepts.
        const double moved = *gains[c] * (1.0 + pull * (step[c] - 1.0));
        *gains[c] = std::clamp(moved, parameters_.lowest, parameters_.highest);
    }
    return true;
}

}  // namespace goalmouth
