#pragma once

#include "core/imaging/colour.h"
#include "core/imaging/colour_gains.h"
#include "core/imaging/colour_table.h"
#include "core/imaging/rgb.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace goalmouth {

/// What colours stand for of which the light has driven a channel to its end. Many colours come to look like
/// one then, and what that one was cannot be worked back. It gets the class that most of them have in the
/// table. Those count less that would lie far beyond the end; unclassified ones that are not dull count only
/// as much altogether as the classified: halls are dull, most other colours never occur. Where all three
/// channels clip it is taken for the darkest grey that would.
class ClippedColours {
  public:
    ClippedColours(const ColourTable& base, const ColourGains& gains);

    /// The class of levels that are seen; nothing where none of their channels clips for the gains' sake, or
    /// no colour of the table comes to look like them.
    std::optional<Colour> at(const Rgb& seen) const;

  private:
    static constexpr int bins = 17;  // an axis, the last one clipped
    static std::size_t bin(double level);

    std::array<bool, 3> driven_;           // red, green, blue: by its gain to an end that it had not reached
    std::vector<std::uint8_t> likeliest_;  // by bin of red, green and blue; colour_count: nothing
};

}  // namespace goalmouth
