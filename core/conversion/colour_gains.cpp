#include "core/conversion/colour_gains.h"

#include <optional>

namespace goalmouth {

namespace {

std::optional<Eigen::Vector3d> colour_of(const double (&levels)[3]) {
    const Eigen::Vector3d colour(levels[0], levels[1], levels[2]);
    if (colour.isZero(0.0)) return std::nullopt;
    return colour;
}

void put(const std::optional<Eigen::Vector3d>& colour, double (&levels)[3]) {
    for (int c = 0; c < 3; ++c) levels[c] = colour ? (*colour)[c] : 0.0;
}

}  // namespace

colour_gains_t to_message(const ColourGains& gains, const KnownColours& known, std::int64_t utime,
                          std::int64_t seq, std::int64_t from_utime) {
    colour_gains_t m{};
    m.utime = utime;
    m.seq = seq;
    m.from_utime = from_utime;
    m.red = gains.red;
    m.green = gains.green;
    m.blue = gains.blue;
    put(known.field, m.field);
    put(known.goal, m.goal);
    return m;
}

ColourGains from_message(const colour_gains_t& message) {
    return {message.red, message.green, message.blue};
}

KnownColours known_colours(const colour_gains_t& message) {
    return {colour_of(message.field), colour_of(message.goal)};
}

}  // namespace goalmouth
