#pragma once

#include "core/conversion/intrinsics.h"
#include "core/imaging/colour_table.h"
#include "core/imaging/yuyv.h"

#include <cstdint>
#include <filesystem>

#include <goalmouth/image_t.hpp>

/// A picture of one upright yellow post on a green field, and a colour table for it.
namespace goalmouth::test {

struct PostScene {
    int width = 320;      // px
    int height = 240;     // px
    int field_top = 100;  // px, first green row
    int post_left = 150;  // px, first yellow column
    int post_right = 165;
    int post_top = 20;
    int post_base = 140;
};

inline Ycbcr scene_colour(const PostScene& s, int x, int y) {
    if (x >= s.post_left && x <= s.post_right && y >= s.post_top && y <= s.post_base) return {170, 50, 150};
    if (y >= s.field_top) return {90, 100, 90};
    return {60, 128, 128};
}

inline YuyvImage scene_image(const PostScene& s = {}) {
    YuyvImage image(s.width, s.height);
    for (int y = 0; y < s.height; ++y) {
        for (int x = 0; x < s.width; x += 2) {
            const Ycbcr a = scene_colour(s, x, y);
            const Ycbcr b = scene_colour(s, x + 1, y);
            std::uint8_t* pair = image.data.data() + y * image.stride() + 2 * x;
            pair[0] = a.y;
            pair[1] = static_cast<std::uint8_t>((a.cb + b.cb) / 2);
            pair[2] = b.y;
            pair[3] = static_cast<std::uint8_t>((a.cr + b.cr) / 2);
        }
    }
    return image;
}

inline ColourTable scene_table() {
    ColourTable table(5, "scene");
    for (int y = 0; y < 256; y += 8) {
        for (int cb = 0; cb < 256; cb += 8) {
            for (int cr = 0; cr < 256; cr += 8) {
                const Ycbcr p{static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(cb),
                              static_cast<std::uint8_t>(cr)};
                if (cb < 90 && cr > 120) table.set(p, Colour::goal);
                if (cb < 115 && cr < 110) table.set(p, Colour::field);
            }
        }
    }
    return table;
}

/// Self-contained.
inline image_t scene_message(std::int64_t seq, const PostScene& s = {}) {
    const YuyvImage image = scene_image(s);
    image_t m{};
    m.utime = 1'000'000 + 33'333 * seq;
    m.seq = seq;
    m.camera = "front";
    m.intrinsics = to_message(scaled_to(Intrinsics{}, s.width, s.height));
    m.width = s.width;
    m.height = s.height;
    m.row_stride = image.stride();
    m.encoding = "yuyv";
    m.slot = -1;
    m.generation = -1;
    m.data = image.data;
    m.size = m.data_size = static_cast<std::int32_t>(image.data.size());
    return m;
}

}  // namespace goalmouth::test
