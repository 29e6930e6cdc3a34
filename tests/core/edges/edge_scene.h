#pragma once

#include "core/imaging/yuyv.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

/// Frames drawn with edges that are known to a fraction of a pixel.
namespace goalmouth::test {

/// Luma and colour differences about neutral, as light has them: a gain scales all three.
struct Shade {
    double y, cb, cr;
    Shade operator*(double k) const { return {k * y, k * cb, k * cr}; }
    Shade mixed(const Shade& other, double share) const {
        return {y + share * (other.y - y), cb + share * (other.cb - cb), cr + share * (other.cr - cr)};
    }
};

inline constexpr Shade green{90.0, -14.0, -32.0};
inline constexpr Shade yellow{150.0, -80.0, 15.0};
inline constexpr Shade white{200.0, 0.0, 0.0};
inline constexpr Shade grey{60.0, 2.0, 1.0};

/// An upright or leaning stripe between two straight edges.
struct Stripe {
    double left = 300.0;  // px, its left edge at y = 0
    double width = 20.0;  // px, along a row
    double slope = 0.0;   // dx/dy
    double top = -100.0;  // px
    double base = 220.0;  // px
    Shade shade = yellow;
    double left_at(double y) const { return left + slope * y; }
    double right_at(double y) const { return left_at(y) + width; }
};

struct EdgeScene {
    int width = 640;
    int height = 480;
    double border = 180.0;  // px, where the field begins
    Shade field = green;
    std::function<Shade(double x, double y)> wall = [](double, double) { return grey; };
    std::vector<Stripe> stripes{Stripe{}};   // the later ones before the earlier ones
    double line_top = 0.0, line_base = 0.0;  // px, rows of a white line along the goal, behind the stripes
    std::function<double(double x, double y)> light = [](double, double) { return 1.0; };
    std::function<Shade(Shade)> cast = [](Shade s) { return s; };
    double blur = 0.8;   // px, σ along rows
    double noise = 0.8;  // grey levels, σ of luma and of each colour difference
    unsigned seed = 1;

    Shade at(double x, double y) const {
        Shade s = y >= border ? field : wall(x, y);
        if (y >= line_top && y < line_base) s = white;
        for (const Stripe& stripe : stripes) {
            if (y < stripe.top || y > stripe.base) continue;
            const auto beyond = [&](double edge) {
                return 0.5 * (1.0 + std::erf((x - edge) / (blur * std::sqrt(2.0))));
            };
            s = s.mixed(stripe.shade, beyond(stripe.left_at(y)) - beyond(stripe.right_at(y)));
        }
        return cast(s * light(x, y));
    }

    YuyvImage draw() const {
        std::mt19937 random(seed);
        std::normal_distribution<double> grain(0.0, noise);
        const auto byte = [&](double value) {
            const double noisy = noise > 0.0 ? value + grain(random) : value;
            return static_cast<std::uint8_t>(std::clamp(std::lround(noisy), 0L, 255L));
        };
        YuyvImage image(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; x += 2) {
                const Shade a = at(x, y);
                const Shade b = at(x + 1, y);
                std::uint8_t* pair = image.data.data() + y * image.stride() + 2 * x;
                pair[0] = byte(a.y);
                pair[1] = byte(128.0 + 0.5 * (a.cb + b.cb));
                pair[2] = byte(b.y);
                pair[3] = byte(128.0 + 0.5 * (a.cr + b.cr));
            }
        }
        return image;
    }
};

}  // namespace goalmouth::test
