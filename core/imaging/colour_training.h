#pragma once

#include "core/imaging/colour.h"
#include "core/imaging/colour_table.h"
#include "core/imaging/yuyv.h"
#include "core/parameters/parameters.h"

#include <array>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace goalmouth {

/// Settings of the classifier. The priors are costs rather than frequencies: how readily a colour two classes
/// share goes to each.
struct ColourTrainingParameters {
    double smoothing_luma = 10.0;   // levels
    double smoothing_chroma = 4.0;  // levels
    double uniform = 0.002;         // share
    double prior_unclassified = 0.35;
    double prior_field = 0.25;
    double prior_line = 0.06;
    double prior_ball = 0.04;
    double prior_goal = 0.30;
    double prior_robot = 0.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, ColourTrainingParameters& p) {
    v("smoothing_luma", p.smoothing_luma, Range{0, 64}, "levels",
      "σ of the Gaussian that smooths the histograms along Y");
    v("smoothing_chroma", p.smoothing_chroma, Range{0, 64}, "levels", "σ along Cb and Cr");
    v("uniform", p.uniform, Range{0, 1}, "1",
      "share of the unclassified density that is spread over all colours: what no sample came near stays "
      "unclassified");
    v("prior_unclassified", p.prior_unclassified, Range{0, 1}, "1", "weight of everything that is no class");
    v("prior_field", p.prior_field, Range{0, 1}, "1", "weight of the field");
    v("prior_line", p.prior_line, Range{0, 1}, "1", "weight of lines");
    v("prior_ball", p.prior_ball, Range{0, 1}, "1", "weight of the ball");
    v("prior_goal", p.prior_goal, Range{0, 1}, "1", "weight of goalposts");
    v("prior_robot", p.prior_robot, Range{0, 1}, "1", "weight of robots");
}

/// Supervised Bayes classifier over YCbCr: a histogram of 64³ cells for each class, smoothed by a Gaussian,
/// normalised to a density and weighted by the prior; each colour goes to the class of the highest product. A
/// class without samples takes nothing.
class ColourTrainer {
  public:
    explicit ColourTrainer(const ColourTrainingParameters& parameters = {});

    void add(Ycbcr p, Colour colour, double weight = 1.0);

    /// Adds every labelled pixel of an image. `labels` is CV_8UC1 of the image's size: a Colour, or
    /// `no_label` for pixels that teach nothing.
    static constexpr std::uint8_t no_label = 255;
    void add(YuyvView image, const cv::Mat& labels);

    /// Sum of weights of the samples of each class.
    const std::array<double, colour_count>& samples() const { return samples_; }

    /// Whether any class but unclassified has samples.
    bool has_class() const;

    /// Throws std::invalid_argument where no class but unclassified has samples.
    ColourTable table(int bits, const std::string& name) const;

  private:
    static constexpr int cell_bits = 6;
    ColourTrainingParameters parameters_;
    std::array<double, colour_count> samples_{};
    std::array<std::vector<float>, colour_count> histograms_;  // as the entries of a 6-bit table
};

}  // namespace goalmouth
