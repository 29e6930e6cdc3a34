#include "core/colour_teaching/taught_table.h"

#include "core/imaging/colour_training.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {

namespace {

std::string percent(double share) {
    return std::to_string(std::lround(100.0 * share)) + " %";
}

}  // namespace

std::optional<ColourTable> taught_table(const ClassSamples& samples, int bits, const std::string& name) {
    ColourTrainer trainer;
    for (std::size_t c = 0; c < colour_count; ++c)
        for (const CountedColour& s : samples[c])
            trainer.add(s.colour, static_cast<Colour>(c), static_cast<double>(s.pixels));
    if (!trainer.has_class()) return std::nullopt;
    return trainer.table(bits, name);
}

std::array<double, colour_count> shares_by_class(std::span<const CountedColour> samples,
                                                 const ColourTable& table) {
    std::array<double, colour_count> shares{};
    for (const CountedColour& s : samples)
        shares[static_cast<std::size_t>(table.at(s.colour))] += static_cast<double>(s.pixels);
    for (double& share : shares) share /= static_cast<double>(pixels_of(samples));
    return shares;
}

std::string clash_of_classes(const ClassSamples& samples, const ColourTable& table) {
    for (std::size_t c = 0; c < colour_count; ++c) {
        if (samples[c].empty()) continue;
        const auto shares = shares_by_class(samples[c], table);
        const auto most =
            static_cast<std::size_t>(std::max_element(shares.begin(), shares.end()) - shares.begin());
        if (most == c || shares[c] >= 0.5) continue;
        const std::string own(colour_names[c]), other(colour_names[most]);
        return own + " and " + other + " were given the same colours: " + percent(shares[most]) +
               " of the samples of " + own + " come out as " + other;
    }
    return {};
}

bool is_black(YuyvView picture) {
    constexpr int brightest = 16;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            if (picture.at(x, y).y > brightest) return false;
    return true;
}

}  // namespace goalmouth
