#pragma once

#include "core/parameters/parameters.h"
#include "core/random/random.h"
#include "core/simulation/ray_table.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace goalmouth {

/// From light on the sensor to the bytes of a webcam.
struct SensorParameters {
    double blur = 0.85;
    double vignetting = 0.0;
    double read_noise = 6.0;
    double photon_noise = 0.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, SensorParameters& p) {
    v("blur", p.blur, Range{0, 8}, "px", "σ of the optical blur");
    v("vignetting", p.vignetting, Range{0, 8}, "1",
      "levels fall by the n-th power of the cosine of the angle to the optical axis; 4: an ideal thin lens, "
      "0: not");
    v("read_noise", p.read_noise, Range{0, 128}, "1",
      "σ of the noise of each pixel's red, green and blue in the dark, in levels of 0…255");
    v("photon_noise", p.photon_noise, Range{0, 16}, "1",
      "variance of that noise gained with each level of light: photon noise, one over the electrons a level "
      "stands for");
}

/// Takes the light of a frame row by row and turns it into YUYV, in the order a camera does: optical blur,
/// vignetting, gains, noise, clipping to 0…255, then BT.601 (full range), the mean chroma of each pair of
/// pixels, rounding. A level of light L gets noise of variance read_noise² + photon_noise · L in each channel
/// on its own. What lies beyond the rim is taken to be like it. Rows come out as soon as the rows below that
/// reach into them are known.
class Sensor {
  public:
    /// `rays` says at which angle to the axis each pixel looks.
    Sensor(const SensorParameters& parameters, const RayTable& rays);

    /// A new frame goes to `out`, rows `stride` bytes apart; `gains` take the light painted to levels. The
    /// noise is a function of `random` alone.
    void begin(std::uint8_t* out, std::ptrdiff_t stride, const Rgb& gains, Random& random);
    /// Where to paint the next row.
    LightRow next_row();
    /// The row is painted. After the last one the whole frame stands in `out`.
    void finish_row();

  private:
    static constexpr std::size_t channels = 3;

    void blur_along(int slot);
    void blur_across(int row);
    void expose(int row);
    void write(int row);

    int width_;
    int height_;
    std::size_t columns_;        // of whole pairs
    int reach_;                  // px the blur reaches
    std::vector<float> kernel_;  // 2·reach + 1 weights, symmetric
    float read_variance_, photon_variance_;
    std::vector<float> vignetting_;                   // factor for each pixel; empty: none
    std::array<std::vector<float>, channels> light_;  // the row being painted, `reach` more on either side
    std::vector<float> rows_;                 // ring of rows blurred along: red, then green, then blue
    std::vector<const float*> sources_;       // rows or shifts of one that a blur sums
    std::vector<float> levels_;               // one row like those, on its way to bytes
    std::vector<std::int32_t> luma_, words_;  // that row as bytes of luma, and as pairs
    std::array<std::vector<float>, channels> noise_;  // tables for σ = 1
    std::vector<std::uint32_t> noise_offset_;         // where each row's noise starts in them
    std::array<float, channels> gains_{};
    std::uint8_t* out_ = nullptr;
    std::ptrdiff_t stride_ = 0;
    int next_ = 0;
};

}  // namespace goalmouth
