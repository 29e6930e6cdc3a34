#pragma once

#include "core/parameters/parameters.h"

#include <Eigen/Core>

namespace goalmouth {

/// Light of the hall: the same from everywhere, plus lamps far away in one direction.
struct LightParameters {
    double ambient = 0.72;
    double directional = 0.34;
    double azimuth = 0.9;
    double elevation = 1.05;
    double limb_darkening = 0.2;
    bool shadows = false;
    double lamp_size = 0.03;
    double temperature = 6500.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, LightParameters& p) {
    v("ambient", p.ambient, Range{0, 4}, "1", "light from everywhere, as a factor of a surface's colour");
    v("directional", p.directional, Range{0, 4}, "1", "light of the lamps on a surface that faces them");
    v("azimuth", p.azimuth, Range{-6.3, 6.3}, "rad", "where the lamps are, from field x towards y");
    v("elevation", p.elevation, Range{0, 1.571}, "rad", "of the lamps above the horizon");
    v("limb_darkening", p.limb_darkening, Range{0, 1}, "1",
      "share of light a round surface loses where it turns away from the camera");
    v("shadows", p.shadows, "goals, robots and ball cast shadows on the ground");
    v("lamp_size", p.lamp_size, Range{0, 0.5}, "rad",
      "angle across the lamps, which makes shadows soft far from what casts them; 0: sharp");
    v("temperature", p.temperature, Range{1700, 25000}, "K", "colour temperature of all light");
}

/// How bright a matt surface is. Normals are unit vectors in frame W.
class Light {
  public:
    explicit Light(const LightParameters& parameters);

    /// Factor for a flat surface.
    double flat(const Eigen::Vector3d& normal) const;
    /// Factor for a round surface; `towards_camera` is the cosine between its normal and the ray to the
    /// camera, across the cylinder's axis.
    float round(float cosine_to_lamps, float towards_camera) const {
        const float lit = cosine_to_lamps > 0.0F ? ambient_ + directional_ * cosine_to_lamps : ambient_;
        return lit * (1.0F - limb_darkening_ * (1.0F - towards_camera));
    }
    float ambient() const { return ambient_; }
    float directional() const { return directional_; }
    float limb_darkening() const { return limb_darkening_; }
    const Eigen::Vector3d& lamps() const { return lamps_; }

    /// Whether things keep the lamps' light from the ground.
    bool shadows() const { return shadows_; }
    double lamp_size() const { return lamp_size_; }  // rad
    /// Share of the light on the ground that comes from the lamps.
    double lamps_share_on_ground() const;

  private:
    float ambient_;
    float directional_;
    float limb_darkening_;
    bool shadows_;
    double lamp_size_;
    Eigen::Vector3d lamps_;  // unit, towards them
};

}  // namespace goalmouth
