#pragma once

namespace goalmouth {

// Whole numbers about one that an int can hold. What <cmath> has for it are calls into a library where the
// compiler must not take a newer processor for granted, and pixels are looked up by the thousand.

/// As std::floor.
inline int whole_below(double x) {
    const int towards_zero = static_cast<int>(x);
    return towards_zero - (static_cast<double>(towards_zero) > x ? 1 : 0);
}

/// As std::ceil.
inline int whole_above(double x) {
    const int towards_zero = static_cast<int>(x);
    return towards_zero + (static_cast<double>(towards_zero) < x ? 1 : 0);
}

/// As std::lround: of two that are as near the one farther from zero.
inline int nearest_whole(double x) {
    const int towards_zero = static_cast<int>(x);
    const double rest = x - static_cast<double>(towards_zero);  // exact
    return towards_zero + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}

}  // namespace goalmouth
