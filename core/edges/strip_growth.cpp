#include "core/edges/strip_growth.h"

#include "core/edges/pair_mean.h"

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

class Growth {
  public:
    Growth(YuyvView image, const FrameEdges& frame, const StripSeed& seed, const StripParameters& parameters,
           const EdgeThreshold& threshold, double straightness, RowStretch& row)
        : image_(image),
          frame_(frame),
          seed_(seed),
          parameters_(parameters),
          threshold_(threshold),
          straightness_(straightness),
          reach_(static_cast<int>(std::ceil(0.5 * straightness))),
          least_step_(std::max(share_of_threshold * static_cast<double>(threshold.strength),
                               share_of_contrast * seed.contrast)),
          row_(row) {
        strip_.left = seed.left;
        strip_.right = seed.right;
    }

    UprightStrip grow() {
        surface_ = seed_.inside;
        std::vector<StripRow>& rows = strip_.rows;
        rows.reserve(frame_.rows.size());
        for (int row = seed_.first_row; row <= seed_.last_row; ++row) look(row, row + 1);
        follow();
        go_on(seed_.last_row + 1, static_cast<int>(frame_.rows.size()), 1);
        const auto up = static_cast<std::ptrdiff_t>(rows.size());
        surface_ = seed_.inside;
        go_on(seed_.first_row - 1, -1, -1);
        std::reverse(rows.begin() + up, rows.end());
        std::rotate(rows.begin(), rows.begin() + up, rows.end());

        // Where no edge follows, nothing says that it is still the strip.
        const auto shows_edge = [](const StripRow& row) { return row.left || row.right; };
        rows.erase(std::find_if(rows.rbegin(), rows.rend(), shows_edge).base(), rows.end());
        rows.erase(rows.begin(), std::find_if(rows.begin(), rows.end(), shows_edge));
        if (strip_.both > 0) strip_.contrast /= strip_.both;
        if (summed_ > 0) strip_.inside = sum_ * (1.F / static_cast<float>(summed_));
        return std::move(strip_);
    }

  private:
    struct Step {
        int pair = 0;       // the first one right of it
        double size = 0.0;  // grey levels, how much more unlike the surface it is outside than inside
    };

    enum class Seen { nothing, surface, edge };

    /// Row by row while the surface shows, and now and then an edge.
    void go_on(int row, int end, int step) {
        int without_surface = 0;
        int without_edge = 0;
        for (; row != end; row += step) {
            switch (look(row, row + step)) {
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

    /// `next`: the row that is looked at after it.
    Seen look(int row, int next) {
        const int y = frame_.rows[static_cast<std::size_t>(row)];
        const double l = strip_.left.at(y);
        const double r = strip_.right.at(y);
        if (r - l < 3.0 || l + r < 0.0 || l + r > 2.0 * image_.width) return Seen::nothing;
        // About its middle, off the edges.
        const int middle = pair_at(0.5 * (l + r));
        const int reach = std::min(static_cast<int>(0.1 * (r - l)), threshold_.window);
        const Appearance inside = mean_of_pairs(image_.row(y), std::max(0, middle - reach),
                                                std::min((image_.width - 1) / 2, middle + reach));
        // The same surface, or at least the same in other light, where a shadow ends on it.
        const bool same = looks_like_surface(inside, shade_share);
        if (!same && !looks_like_surface(inside, 0.F)) return Seen::nothing;

        const int beside = reach_ + threshold_.window;
        row_.load(image_, y, border_at(l) - beside, border_at(r) + beside);
        if (next >= 0 && next < static_cast<int>(frame_.rows.size()))
            row_.ask_for(image_, frame_.rows[static_cast<std::size_t>(next)]);
        const auto left = strongest_step(l, inside, ChainSide::left);
        const auto right = strongest_step(r, inside, ChainSide::right);
        StripRow found;
        found.y = y;
        if (left) found.left = believed(*left, l);
        if (right) found.right = believed(*right, r);
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

    std::optional<Step> strongest_step(double x, const Appearance& surface, ChainSide side) {
        const int w = threshold_.window;
        const int first = std::max(row_.first() + w, border_at(x) - reach_);
        const int last = std::min(row_.end() - w, border_at(x) + reach_);
        if (first > last) return std::nullopt;
        // Boxes right of each place, and before them those left of it.
        const auto unlike = row_.unlikeness(first - w, last, w, surface, threshold_.chroma_weight);
        const auto* before = unlike.data();
        const auto* after = before + w;
        if (side == ChainSide::right) std::swap(before, after);
        Step step;
        float most = before[0] - after[0];
        int best = 0;
        for (int i = 1; i <= last - first; ++i) {
            const float size = before[i] - after[i];
            best = size > most ? i : best;
            most = std::max(most, size);
        }
        step.pair = first + best;
        step.size = static_cast<double>(most);
        return step;
    }

    std::optional<float> believed(const Step& step, double expected) const {
        if (step.size < least_step_) return std::nullopt;
        // Sides as they are where blur has ended.
        const int w = threshold_.window;
        const int gap = w > 1 ? 1 : 0;
        const Appearance left = row_.mean(step.pair - w, step.pair - 1 - gap);
        const Appearance right = row_.mean(step.pair + gap, step.pair + w - 1);
        const Appearance change = right - left;
        if (!(change.dot(change) > 0.F)) return std::nullopt;
        const double x = row_.step_place(step.pair, w, left, right);
        if (std::abs(x - expected) > straightness_) return std::nullopt;
        return static_cast<float>(x);
    }

    bool looks_like_surface(const Appearance& inside, float shade) const {
        const double bound = parameters_.sameness * seed_.contrast;
        return static_cast<double>(squared_unlikeness(inside, surface_, threshold_.chroma_weight, shade)) <=
               bound * bound;
    }
    static int pair_at(double x) { return whole(0.5 * (x + 0.5)); }
    /// The pair with the left border that is nearest to x.
    static int border_at(double x) { return whole(0.5 * (x + 0.5) + 0.5); }
    /// The largest whole number that is no larger; std::floor() is a call on processors of any age.
    static int whole(double x) {
        const int towards_zero = static_cast<int>(x);
        return towards_zero - (x < towards_zero ? 1 : 0);
    }

    YuyvView image_;
    const FrameEdges& frame_;
    const StripSeed& seed_;
    const StripParameters& parameters_;
    EdgeThreshold threshold_;
    double straightness_;
    int reach_;          // how far from where it is expected an edge is sought [pairs]
    double least_step_;  // grey levels, of an edge
    RowStretch& row_;
    UprightStrip strip_;
    Appearance surface_;  // as it was last seen
    Appearance sum_;      // of the insides of the rows that show an edge,
    int summed_ = 0;      // so many
    UprightFit left_, right_;
};

}  // namespace

UprightStrip grow_strip(YuyvView image, const FrameEdges& frame, const StripSeed& seed,
                        const StripParameters& parameters, const EdgeThreshold& threshold,
                        double straightness, RowStretch& row) {
    return Growth(image, frame, seed, parameters, threshold, straightness, row).grow();
}

}  // namespace goalmouth
