#include "core/conversion/colour_gains.h"

namespace goalmouth {

colour_gains_t to_message(const ColourGains& gains, std::int64_t utime, std::int64_t seq,
                          std::int64_t from_utime) {
    colour_gains_t m{};
    m.utime = utime;
    m.seq = seq;
    m.from_utime = from_utime;
    m.red = gains.red;
    m.green = gains.green;
    m.blue = gains.blue;
    return m;
}

ColourGains from_message(const colour_gains_t& message) {
    return {message.red, message.green, message.blue};
}

}  // namespace goalmouth
