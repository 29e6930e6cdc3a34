#include "core/refinement/foot_ground.h"

#include "core/refinement/camera_response.h"
#include "core/refinement/whole_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace goalmouth {
namespace {

constexpr int lowest = 8;                       // px, from the foot up, or
constexpr std::size_t fewest = 4;               // rows
constexpr int below_first = 4, below_rows = 4;  // px: from there on below it, so many rows
constexpr int least_rows = 2;
constexpr double beside = 4.0;  // px
constexpr float least_chroma = 12.0F, alike = 10.0F;
constexpr float darkest = 0.65F, brightest = 1.5F;

/// Mean over the pairs between two columns, added where they lie in the picture.
class Mean {
  public:
    explicit Mean(YuyvView image) : image_(image) {}
    bool add(int y, double from, double to) {
        const int first = PairRow::pair_at(std::min(from, to)), last = PairRow::pair_at(std::max(from, to));
        if (y < 0 || y >= image_.height || first < 0 || last >= image_.width / 2) return false;
        PairRow(image_.row(y), image_.width / 2, CameraResponse::linear).add(first, last, sum_);
        pairs_ += static_cast<float>(last - first + 1);
        return true;
    }
    PairColour value() const { return sum_ / std::max(1.0F, pairs_); }

  private:
    YuyvView image_;
    PairColour sum_ = PairColour::Zero();
    float pairs_ = 0.0F;
};

}  // namespace

bool ends_on_ground(YuyvView image, const std::vector<LinePoint>& edge, int outwards, double width,
                    double blur) {
    if (edge.empty()) return false;
    const LinePoint& foot = edge.back();
    // A post that leans has its foot lower on one side.
    const int length = foot.y - edge.front().y;
    const double slant = length > 0 ? (foot.x - edge.front().x) / length : 0.0;
    const int lower = below_first + whole_above(0.8 * width * std::abs(slant));
    Mean ground(image);
    for (int k = lower; k < lower + below_rows; ++k) {
        const double x = foot.x + k * slant;
        if (!ground.add(foot.y + k, x - outwards * 0.2 * width, x - outwards * 0.8 * width)) return false;
    }
    const PairColour below = ground.value();
    if (!(below.tail<2>().norm() > least_chroma)) return false;
    const double clear = 2.5 * blur + 1.5;
    int rows = 0;
    for (std::size_t i = 0; i < edge.size(); ++i) {
        const LinePoint& point = edge[i];
        if (point.y < foot.y - lowest && i + fewest < edge.size()) continue;
        Mean outside(image);
        if (!outside.add(point.y, point.x + outwards * clear, point.x + outwards * (clear + beside)))
            continue;
        const PairColour here = outside.value();
        const bool is_ground = (here - below).tail<2>().norm() < alike && here[0] > darkest * below[0] &&
                               here[0] < brightest * below[0];
        rows += is_ground ? 1 : 0;
    }
    return rows >= least_rows;
}

}  // namespace goalmouth
