#include "core/segmentation/transition.h"

#include <algorithm>

namespace goalmouth {

float locate_transition(YuyvView image, Orientation orientation, int line, int boundary,
                        TransitionWindow window) {
    const bool along_row = orientation == Orientation::horizontal;
    const int length = along_row ? image.width : image.height;
    int first = std::max(0, boundary - window.before);
    int last = std::min(length - 1, boundary + window.after - 1);
    if (along_row) {
        first -= first % 2;
        last = std::min(length - 1, last + (last + 1) % 2);
    }

    const auto at = [&](int i) { return along_row ? image.at(i, line) : image.at(line, i); };
    const Ycbcr a = at(first);
    const Ycbcr b = at(last);
    const int dy = b.y - a.y;
    const int dcb = b.cb - a.cb;
    const int dcr = b.cr - a.cr;
    const int contrast = dy * dy + dcb * dcb + dcr * dcr;
    const float nominal = static_cast<float>(boundary) - 0.5F;
    if (contrast == 0) return nominal;

    int still_a = 0;  // Σ (1 − share), in units of 1/contrast
    for (int i = first; i <= last; ++i) {
        const Ycbcr p = at(i);
        const int share = dy * (p.y - a.y) + dcb * (p.cb - a.cb) + dcr * (p.cr - a.cr);
        still_a += contrast - std::clamp(share, 0, contrast);
    }
    const float edge =
        static_cast<float>(first) - 0.5F + static_cast<float>(still_a) / static_cast<float>(contrast);
    return std::clamp(edge, nominal - 2.0F, nominal + 2.0F);
}

}  // namespace goalmouth
