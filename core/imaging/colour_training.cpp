#include "core/imaging/colour_training.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace goalmouth {

namespace {

constexpr int side = 64;
constexpr double levels_per_cell = 256.0 / side;

std::vector<float> gaussian(double sigma) {
    const int reach = static_cast<int>(std::ceil(3.0 * sigma));
    std::vector<float> kernel;
    for (int i = -reach; i <= reach; ++i)
        kernel.push_back(sigma > 0.0 ? static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma))) : 1.0F);
    const float sum = std::accumulate(kernel.begin(), kernel.end(), 0.0F);
    for (float& value : kernel) value /= sum;
    return kernel;
}

/// Convolves along one axis of a 64³ array; what would leave the array stays in its last cell, so nothing is
/// lost.
void smooth_axis(std::vector<float>& cells, std::size_t stride, const std::vector<float>& kernel) {
    const int reach = static_cast<int>(kernel.size() / 2);
    std::array<float, side> line{};
    for (std::size_t start = 0; start < cells.size(); ++start) {
        if ((start / stride) % side != 0) continue;
        line.fill(0.0F);
        for (int i = 0; i < side; ++i) {
            const float value = cells[start + static_cast<std::size_t>(i) * stride];
            if (value == 0.0F) continue;
            for (int k = -reach; k <= reach; ++k)
                line[static_cast<std::size_t>(std::clamp(i + k, 0, side - 1))] +=
                    value * kernel[static_cast<std::size_t>(k + reach)];
        }
        for (int i = 0; i < side; ++i)
            cells[start + static_cast<std::size_t>(i) * stride] = line[static_cast<std::size_t>(i)];
    }
}

}  // namespace

ColourTrainer::ColourTrainer(const ColourTrainingParameters& parameters) : parameters_(parameters) {}

void ColourTrainer::add(Ycbcr p, Colour colour, double weight) {
    static const ColourTable cells(cell_bits);
    const auto i = static_cast<std::size_t>(colour);
    if (histograms_[i].empty()) histograms_[i].assign(cells.entries().size(), 0.0F);
    histograms_[i][cells.index(p)] += static_cast<float>(weight);
    samples_[i] += weight;
}

void ColourTrainer::add(YuyvView image, const cv::Mat& labels) {
    if (labels.type() != CV_8UC1 || labels.cols != image.width || labels.rows != image.height)
        throw std::invalid_argument("labels must be one byte for each pixel of the image");
    for (int y = 0; y < image.height; ++y) {
        const std::uint8_t* row = labels.ptr<std::uint8_t>(y);
        for (int x = 0; x < image.width; ++x)
            if (row[x] < colour_count) add(image.at(x, y), static_cast<Colour>(row[x]));
    }
}

bool ColourTrainer::has_class() const {
    return std::any_of(samples_.begin() + 1, samples_.end(), [](double n) { return n > 0.0; });
}

ColourTable ColourTrainer::table(int bits, const std::string& name) const {
    if (!has_class()) throw std::invalid_argument("no sample of any colour class");
    const ColourTrainingParameters& p = parameters_;
    const std::array<double, colour_count> priors = {p.prior_unclassified, p.prior_field, p.prior_line,
                                                     p.prior_ball,         p.prior_goal,  p.prior_robot};
    const std::vector<float> along_luma = gaussian(p.smoothing_luma / levels_per_cell);
    const std::vector<float> along_chroma = gaussian(p.smoothing_chroma / levels_per_cell);

    ColourTable table(cell_bits, name);
    const std::size_t cells = table.entries().size();
    const auto floor =
        static_cast<float>(std::max(1e-12, p.prior_unclassified * p.uniform / static_cast<double>(cells)));
    std::vector<float> best(cells, floor);
    for (std::size_t c = 0; c < colour_count; ++c) {
        if (samples_[c] <= 0.0) continue;
        std::vector<float> density = histograms_[c];
        smooth_axis(density, 1, along_luma);
        smooth_axis(density, side, along_chroma);
        smooth_axis(density, static_cast<std::size_t>(side) * side, along_chroma);
        const auto weight = static_cast<float>(priors[c] / samples_[c] * (c == 0 ? 1.0 - p.uniform : 1.0));
        for (std::size_t i = 0; i < cells; ++i) {
            const float score = density[i] * weight + (c == 0 ? floor : 0.0F);
            if (score > best[i]) {
                best[i] = score;
                table.entries()[i] = static_cast<std::uint8_t>(c);
            }
        }
    }
    return resampled(table, bits);
}

}  // namespace goalmouth
