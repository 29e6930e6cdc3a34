#include "core/imaging/clipped_colours.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {

namespace {

constexpr int step = 4;               // levels between the colours of the base that are tried
constexpr double usual_excess = 0.5;  // of the end, by which a clipped channel would lie beyond it
}  // namespace

std::size_t ClippedColours::bin(double level) {
    if (level >= clipped_level) return bins - 1;
    return static_cast<std::size_t>(std::max(level, 0.0) / (256.0 / (bins - 1)));
}

ClippedColours::ClippedColours(const ColourTable& base, const ColourGains& gains)
    : driven_{255.0 / gains.red < clipped_level, 255.0 / gains.green < clipped_level,
              255.0 / gains.blue < clipped_level},
      likeliest_(bins * bins * bins, static_cast<std::uint8_t>(colour_count)) {
    // For each level that is tried of a channel: where it comes to lie, and how much it counts.
    struct Seen {
        std::size_t bin;
        double weight;
    };
    const auto seen_under = [](double gain) {
        std::array<Seen, 256 / step> seen{};
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const double now = gain * (static_cast<double>(i) + 0.5) * step;
            seen[i] = {bin(now), std::exp(-std::max(0.0, now / 255.0 - 1.0) / usual_excess)};
        }
        return seen;
    };
    const auto red = seen_under(gains.red), green = seen_under(gains.green), blue = seen_under(gains.blue);
    std::vector<std::array<double, colour_count>> weights(likeliest_.size());
    std::vector<double> odd_weights(likeliest_.size());  // of the unclassified that are not dull
    double classified = 0.0, odd_ones = 0.0;
    const auto of = [](std::size_t i) { return (static_cast<double>(i) + 0.5) * step; };
    for (std::size_t r = 0; r < red.size(); ++r) {
        for (std::size_t g = 0; g < green.size(); ++g) {
            for (std::size_t b = 0; b < blue.size(); ++b) {
                const Rgb rgb{of(r), of(g), of(b)};
                const Colour colour = base.at(ycbcr_of(rgb));
                const bool odd = colour == Colour::unclassified && !is_dull(rgb);
                (odd ? odd_ones : classified) += colour != Colour::unclassified || odd ? 1.0 : 0.0;
                const std::size_t seen = (red[r].bin * bins + green[g].bin) * bins + blue[b].bin;
                (odd ? odd_weights[seen] : weights[seen][static_cast<std::size_t>(colour)]) +=
                    red[r].weight * green[g].weight * blue[b].weight;
            }
        }
    }
    const double common = odd_ones > classified ? classified / odd_ones : 1.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        weights[i][static_cast<std::size_t>(Colour::unclassified)] += common * odd_weights[i];
        const auto most = std::max_element(weights[i].begin(), weights[i].end());
        if (*most > 0.0) likeliest_[i] = static_cast<std::uint8_t>(most - weights[i].begin());
    }
    const double grey = std::min(255.0, 255.0 / std::min({gains.red, gains.green, gains.blue}));
    likeliest_.back() = static_cast<std::uint8_t>(base.at(ycbcr_of(Rgb{grey, grey, grey})));
}

std::optional<Colour> ClippedColours::at(const Rgb& seen) const {
    const std::size_t r = bin(seen.red), g = bin(seen.green), b = bin(seen.blue);
    constexpr std::size_t last = bins - 1;
    if (!((driven_[0] && r == last) || (driven_[1] && g == last) || (driven_[2] && b == last)))
        return std::nullopt;
    const std::uint8_t likeliest = likeliest_[(r * bins + g) * bins + b];
    if (likeliest == colour_count) return std::nullopt;
    return static_cast<Colour>(likeliest);
}

}  // namespace goalmouth
