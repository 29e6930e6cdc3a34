#include "core/edges/strip_growth.h"

#include "core/edges/chroma_row.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

/// Rows with an edge that it takes to know a line better than the seed does.
constexpr double rows_of_a_line = 4.0;

/// The surface may go on without an edge for so many times as many rows as it may itself be missing on.
constexpr int rows_without_edge = 4;

/// An edge is believed where the surface ends by this share of the frame's threshold or of what the seed
/// shows.
constexpr double share_of_threshold = 0.5;
constexpr double share_of_contrast = 0.15;
constexpr double share_in_other_light = 0.6;

/// Sums over the pairs of a stretch of a row.
class StretchSums {
  public:
    /// Pairs first … end − 1, all inside the picture.
    void read(YuyvView image, int y, int first, int end) {
        first_ = first;
        sums_.resize(static_cast<std::size_t>(end - first) + 1);
        const std::uint8_t* pair = image.row(y) + 4 * first;
        Sum sum;
        for (Sum& before : sums_) {
            before = sum;
            if (&before == &sums_.back()) break;
            sum = {sum.y + pair[0] + pair[2], sum.cb + pair[1] - 128, sum.cr + pair[3] - 128};
            pair += 4;
        }
    }
    Appearance mean(int first, int end) const {
        const Sum& a = sums_[static_cast<std::size_t>(first - first_)];
        const Sum& b = sums_[static_cast<std::size_t>(end - first_)];
        const float share = 1.F / static_cast<float>(end - first);
        return Appearance{0.5F * static_cast<float>(b.y - a.y), static_cast<float>(b.cb - a.cb),
                          static_cast<float>(b.cr - a.cr)} *
               share;
    }

  private:
    struct Sum {
        int y = 0, cb = 0, cr = 0;
    };
    int first_ = 0;
    std::vector<Sum> sums_;
};

class Growth {
  public:
    Growth(YuyvView image, const FrameEdges& frame, const StripSeed& seed, const StripParameters& parameters,
           const EdgeThreshold& threshold, double straightness)
        : image_(image),
          frame_(frame),
          seed_(seed),
          parameters_(parameters),
          threshold_(threshold),
          straightness_(straightness) {
        strip_.left = seed.left;
        strip_.right = seed.right;
    }

    UprightStrip grow() {
        surface_ = seed_.inside;
        for (int row = seed_.first_row; row <= seed_.last_row; ++row) look(row);
        follow();
        go_on(seed_.last_row + 1, static_cast<int>(frame_.rows.size()), 1);
        surface_ = seed_.inside;
        go_on(seed_.first_row - 1, -1, -1);

        std::sort(strip_.rows.begin(), strip_.rows.end(),
                  [](const StripRow& a, const StripRow& b) { return a.y < b.y; });
        // Where no edge follows, nothing says that it is still the strip.
        const auto shows_edge = [](const StripRow& row) { return row.left || row.right; };
        const auto first = std::find_if(strip_.rows.begin(), strip_.rows.end(), shows_edge);
        const auto last = std::find_if(strip_.rows.rbegin(), strip_.rows.rend(), shows_edge).base();
        strip_.rows = first < last ? std::vector<StripRow>(first, last) : std::vector<StripRow>();
        if (strip_.both > 0) strip_.contrast /= strip_.both;
        if (summed_ > 0) strip_.inside = sum_ * (1.F / static_cast<float>(summed_));
        return std::move(strip_);
    }

  private:
    struct Step {
        int pair = 0;  // the first one right of it
        Appearance outside, inside;
        double size = 0.0;  // grey levels, how much more unlike the surface it is outside than inside
    };

    enum class Seen { nothing, surface, edge };

    /// Row by row while the surface shows, and now and then an edge.
    void go_on(int row, int end, int step) {
        int without_surface = 0;
        int without_edge = 0;
        for (; row != end; row += step) {
            switch (look(row)) {
                case Seen::edge:
                    follow();
                    without_surface = without_edge = 0;
                    break;
                case Seen::surface:
                    without_surface = 0;
                    if (++without_edge > rows_without_edge * parameters_.largest_gap) return;
                    break;
                case Seen::nothing:
                    if (++without_surface > parameters_.largest_gap) return;
                    break;
            }
        }
    }

    void follow() {
        if (left_.points() >= rows_of_a_line) strip_.left = left_.line();
        if (right_.points() >= rows_of_a_line) strip_.right = right_.line();
    }

    Seen look(int row) {
        const int y = frame_.rows[static_cast<std::size_t>(row)];
        const double l = strip_.left.at(y);
        const double r = strip_.right.at(y);
        if (r - l < 3.0 || l + r < 0.0 || l + r > 2.0 * image_.width) return Seen::nothing;
        // About its middle, off the edges.
        const int middle = pair_at(0.5 * (l + r));
        const int reach = std::min(static_cast<int>(0.1 * (r - l)), threshold_.window);
        const Appearance inside = mean_of_pairs(image_, y, middle - reach, middle + reach);
        // The same surface, or at least the same in other light, where a shadow ends on it.
        const double bound = parameters_.sameness * seed_.contrast;
        const bool same = unlike(inside, surface_) <= bound;
        if (!same && unlike(inside, surface_, 0.F) > bound) return Seen::nothing;

        const auto left = strongest_step(y, l, inside, ChainSide::left);
        const auto right = strongest_step(y, r, inside, ChainSide::right);
        StripRow found;
        found.y = y;
        if (left) found.left = believed(y, *left, l, ChainSide::left);
        if (right) found.right = believed(y, *right, r, ChainSide::right);
        if (!same) {
            // Both edges then have to be as distinct, for that light, as they were.
            const double light = std::min(1.0, static_cast<double>(inside.y / std::max(surface_.y, 1.F)));
            const double least = share_in_other_light * light * seed_.contrast;
            if (!found.left || !found.right || std::min(left->size, right->size) < least)
                return Seen::nothing;
        }
        if (!found.left && !found.right) {
            strip_.rows.push_back(found);
            return Seen::surface;
        }
        if (found.left) left_.add(static_cast<double>(*found.left), y);
        if (found.right) right_.add(static_cast<double>(*found.right), y);
        if (found.left && found.right) {
            ++strip_.both;
            strip_.contrast += std::min(left->size, right->size);
        }
        strip_.rows.push_back(found);
        sum_ = sum_ + inside;
        ++summed_;
        surface_ = same ? surface_ * 0.85F + inside * 0.15F : inside;
        return Seen::edge;
    }

    std::optional<Step> strongest_step(int y, double x, const Appearance& surface, ChainSide side) {
        const int w = threshold_.window;
        const int reach = static_cast<int>(std::ceil(0.5 * straightness_));
        const int middle = static_cast<int>(std::lround(0.5 * (x + 0.5)));
        const int first = std::max(w, middle - reach);
        const int last = std::min((image_.width + 1) / 2 - w, middle + reach);
        if (first > last) return std::nullopt;
        sums_.read(image_, y, first - w, last + w);
        std::optional<Step> best;
        for (int i = first; i <= last; ++i) {
            Step step;
            step.pair = i;
            step.outside = sums_.mean(i - w, i);
            step.inside = sums_.mean(i, i + w);
            if (side == ChainSide::right) std::swap(step.outside, step.inside);
            step.size = unlike(step.outside, surface) - unlike(step.inside, surface);
            if (!best || step.size > best->size) best = step;
        }
        if (w > 1) {
            // For its place, sides as they are where blur has ended.
            best->outside = sums_.mean(best->pair - w, best->pair - 1);
            best->inside = sums_.mean(best->pair + 1, best->pair + w);
            if (side == ChainSide::right) std::swap(best->outside, best->inside);
        }
        return best;
    }

    std::optional<float> believed(int y, const Step& step, double expected, ChainSide side) const {
        const double least = std::max(share_of_threshold * static_cast<double>(threshold_.strength),
                                      share_of_contrast * seed_.contrast);
        if (step.size < least) return std::nullopt;
        const double x = side == ChainSide::left ? locate(y, step.pair, step.outside, step.inside)
                                                 : locate(y, step.pair, step.inside, step.outside);
        if (!(std::abs(x - expected) <= straightness_))
            return std::nullopt;  // nor where both sides are alike
        return static_cast<float>(x);
    }

    /// A step from a to b about the left side of a pair.
    double locate(int y, int pair, const Appearance& a, const Appearance& b) const {
        const Appearance change = b - a;
        const float whole = change.dot(change);
        const int w = 2 * threshold_.window;
        const int first = std::max(0, 2 * pair - w);
        const int last = std::min(image_.width, 2 * pair + w) - 1;
        float still_a = 0.F;
        for (int x = first; x <= last; ++x) {
            const Ycbcr p = image_.at(x, y);
            const Appearance here{static_cast<float>(p.y), static_cast<float>(p.cb) - 128.F,
                                  static_cast<float>(p.cr) - 128.F};
            still_a += 1.F - std::clamp((here - a).dot(change) / whole, 0.F, 1.F);
        }
        return first - 0.5 + static_cast<double>(still_a);
    }

    double unlike(const Appearance& a, const Appearance& surface, float shade = 0.25F) const {
        return std::sqrt(
            static_cast<double>(squared_unlikeness(a, surface, threshold_.chroma_weight, shade)));
    }
    static int pair_at(double x) { return static_cast<int>(std::floor(0.5 * (x + 0.5))); }

    YuyvView image_;
    const FrameEdges& frame_;
    const StripSeed& seed_;
    const StripParameters& parameters_;
    EdgeThreshold threshold_;
    double straightness_;
    UprightStrip strip_;
    Appearance surface_;  // as it was last seen
    Appearance sum_;      // of the insides of the rows that show an edge,
    int summed_ = 0;      // so many
    UprightFit left_, right_;
    StretchSums sums_;
};

}  // namespace

UprightStrip grow_strip(YuyvView image, const FrameEdges& frame, const StripSeed& seed,
                        const StripParameters& parameters, const EdgeThreshold& threshold,
                        double straightness) {
    return Growth(image, frame, seed, parameters, threshold, straightness).grow();
}

}  // namespace goalmouth
