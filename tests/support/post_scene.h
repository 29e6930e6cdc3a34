#pragma once

#include "core/conversion/intrinsics.h"
#include "core/imaging/colour_table.h"
#include "core/imaging/yuyv.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <random>

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

/// The same as a lens and a sensor would have it: blurred by a pixel, with noise.
inline YuyvImage lifelike_scene_image(const PostScene& s = {}, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 1.5);
    const auto at = [&](int x, int y, auto component) {
        constexpr double weights[] = {0.06, 0.24, 0.4, 0.24, 0.06};
        double sum = 0.0;
        for (int i = 0; i < 5; ++i) {
            for (int j = 0; j < 5; ++j)
                sum += weights[i] * weights[j] * component(scene_colour(s, x + j - 2, y + i - 2));
        }
        return sum;
    };
    const auto byte = [&](double value) {
        return static_cast<std::uint8_t>(std::clamp(std::lround(value + noise(random)), 0L, 255L));
    };
    YuyvImage image(s.width, s.height);
    for (int y = 0; y < s.height; ++y) {
        for (int x = 0; x < s.width; x += 2) {
            const auto pair_of = [&](auto component) {
                return 0.5 * (at(x, y, component) + at(x + 1, y, component));
            };
            std::uint8_t* pair = image.data.data() + y * image.stride() + 2 * x;
            pair[0] = byte(at(x, y, [](Ycbcr c) { return static_cast<double>(c.y); }));
            pair[1] = byte(pair_of([](Ycbcr c) { return static_cast<double>(c.cb); }));
            pair[2] = byte(at(x + 1, y, [](Ycbcr c) { return static_cast<double>(c.y); }));
            pair[3] = byte(pair_of([](Ycbcr c) { return static_cast<double>(c.cr); }));
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
