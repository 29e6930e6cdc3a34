#pragma once

namespace goalmouth {

/// What a surface looks like: luma and the two colour differences about neutral, in grey levels.
struct Appearance {
    float y = 0.F;   // 0…255
    float cb = 0.F;  // −128…127
    float cr = 0.F;  // −128…127

    Appearance operator+(const Appearance& o) const { return {y + o.y, cb + o.cb, cr + o.cr}; }
    Appearance operator-(const Appearance& o) const { return {y - o.y, cb - o.cb, cr - o.cr}; }
    Appearance operator*(float k) const { return {k * y, k * cb, k * cr}; }
    float dot(const Appearance& o) const { return y * o.y + cb * o.cb + cr * o.cr; }
};

/// Squared size of a difference, the colour differences weighted as in gradients.
inline float squared_size(const Appearance& d, float chroma_weight) {
    return d.y * d.y + chroma_weight * (d.cb * d.cb + d.cr * d.cr);
}

/// What counts of the square of a difference that light and shade make.
inline constexpr float shade_share = 0.25F;

/// How unlike `surface` something looks, squared. What light and shade do to a surface, more or less of its
/// own colour, counts `shade` of its square: a post is a cylinder with a bright and a dark side, and shadows
/// fall on it.
inline float squared_unlikeness(const Appearance& a, const Appearance& surface, float chroma_weight,
                                float shade = shade_share) {
    const Appearance d = a - surface;
    const float own = surface.dot(surface);
    const Appearance along = surface * (own > 0.F ? d.dot(surface) / own : 0.F);
    return squared_size(d - along, chroma_weight) + shade * squared_size(along, chroma_weight);
}

}  // namespace goalmouth
