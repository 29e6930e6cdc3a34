#pragma once

#include "core/parameters/parameters.h"

namespace goalmouth {

/// When each row of the image gathers light. Row v of h is read at (v / (h − 1) − ½) · readout after the
/// frame's time and has gathered light over `exposure` about that moment (rolling shutter).
struct ShutterParameters {
    double exposure = 0.0;
    double readout = 0.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, ShutterParameters& p) {
    v("exposure", p.exposure, Range{0, 1}, "s",
      "time over which each row gathers light: motion blur; 0: an instant");
    v("readout", p.readout, Range{0, 1}, "s",
      "from the first row to the last: rolling shutter; 0: all rows at once");
}

/// When a row is read [s], counted from the frame's time; also between rows.
inline double row_time(const ShutterParameters& shutter, double row, int height) {
    return height > 1 ? (row / (height - 1) - 0.5) * shutter.readout : 0.0;
}

}  // namespace goalmouth
