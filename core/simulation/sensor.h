#pragma once

#include "core/parameters/parameters.h"
#include "core/random/random.h"
#include "core/simulation/ray_table.h"

#include <cstddef>
#include <cstdint>
#include <memory>
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

/// Takes the light of a frame row by row, blurs it, adds noise and writes YUYV (4:2:2, BT.601, full range;
/// the chroma of a pair is the mean of its two pixels'). Rows come out as soon as the rows below that reach
/// into them are known.
class Sensor {
  public:
    Sensor(const SensorParameters& parameters, int width, int height);

    /// A new frame goes to `out`, rows `stride` bytes apart. The noise is a function of `random` alone.
    void begin(std::uint8_t* out, std::ptrdiff_t stride, Random& random);
    /// Where to paint the next row.
    LightRow next_row();
    /// The row is painted. After the last one the whole frame stands in `out`.
    void finish_row();

  private:
    void blur_along(int slot);
    void write_row(int row);

    int width_;
    int height_;
    int pairs_;
    int reach_;                         // px the blur reaches
    std::vector<float> kernel_;         // 2·reach + 1 weights
    std::vector<float> chroma_kernel_;  // 2·reach + 2 weights: the blur after the mean of a pair
    float noise_;
    std::vector<float> r_, g_, b_;
    std::vector<float> luma_, cb_even_, cb_odd_, cr_even_,
        cr_odd_;                                        // one row, with `reach` more on either side
    std::vector<float> rows_;                           // ring of blurred rows: luma, then Cb, then Cr
    std::vector<float> sum_;                            // one row like those, blurred both ways
    std::vector<std::int32_t> levels_, words_;          // that row as numbers of 0…255, and as pairs
    std::vector<std::uint32_t> noise_offset_;           // where each row's noise starts in the table
    std::vector<float> noise_y_, noise_cb_, noise_cr_;  // table for σ = 1
    std::uint8_t* out_ = nullptr;
    std::ptrdiff_t stride_ = 0;
    int next_ = 0;
};

}  // namespace goalmouth
