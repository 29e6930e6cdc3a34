#include "core/refinement/edge_rivals.h"

#include "core/refinement/foot_ground.h"
#include "core/refinement/luma_line.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

constexpr int least_rows = 6;
constexpr double least_share = 0.08;             // of the rows that end here or there
constexpr double is_line = 15.0, is_none = 7.0;  // χ² of a line's two degrees of freedom
constexpr double vaguest_line = 4.0;             // levels; what is less sharp than that need be no line
constexpr double faintest_line = 1.5;            // levels; where a step's sigma is more, none means nothing
constexpr double about = 1.5, pace = 0.5;        // px: colour ends to within a pair of pixels
constexpr int mostly = 2;
// To move an edge out, beside what ends here:
constexpr double enough_outside = 0.5, many_outside = 1.5;
constexpr int least_outside = 15;

double at(const RunEnd& row, double beyond, double width) {
    return beyond * row.width / width;
}

class Judge {
  public:
    Judge(YuyvView image, const RunEnds& ends, int outwards, double blur)
        : image_(image), ends_(ends), outwards_(outwards), blur_(blur) {
        for (const RunEnd& row : ends.rows) width_ += row.width / static_cast<double>(ends.rows.size());
    }

    double width() const { return width_; }  // px, mean
    /// As a multiple of that, the width of a post with its edge at the place.
    double wider(const RunEnds::Place& place) const { return (width_ + place.beyond) / width_; }
    bool counts(const RunEnds::Place& place, int here) const {
        return place.rows >= least_rows && place.rows >= least_share * (here + place.rows);
    }
    /// A line at the edge, of a post that goes on for `beyond` px as rows that end there say.
    std::optional<LumaLine> line_at_edge(const RunEnds::Place& place) const {
        const auto ends_there = [&](const RunEnd& row) { return ends_at(row, place); };
        return line(0.0, {outwards_, place.beyond, width_ + place.beyond, blur_}, ends_there);
    }
    /// The clearest about a place inside the edge, in the rows that end at the edge.
    std::optional<LumaLine> line_about(const RunEnds::Place& place) const {
        std::optional<LumaLine> best;
        for (double off = -about; off <= about; off += pace) {
            const double beyond = place.beyond + off;
            const auto found = line(beyond, {outwards_, -beyond, width_, blur_},
                                    [&](const RunEnd& row) { return ends_.ends_here(row); });
            if (found && (!best || found->chi2 > best->chi2)) best = found;
        }
        return best;
    }
    bool ends_at(const RunEnd& row, const RunEnds::Place& place) const {
        return std::abs(row.beyond - place.beyond) <= ends_.spread;
    }
    /// Of the rows that end at a place, how many lie above, among and below nearly all that end at the edge.
    struct Order {
        int above = 0, among = 0, below = 0;
    };
    Order order(const RunEnds::Place& place) const {
        std::vector<int> here;
        for (const RunEnd& row : ends_.rows)
            if (ends_.ends_here(row)) here.push_back(row.y);
        if (here.empty()) return {};
        const int high = here[here.size() / 10], low = here[here.size() * 9 / 10];
        Order found;
        for (const RunEnd& row : ends_.rows)
            if (ends_at(row, place)) ++(row.y < high ? found.above : row.y > low ? found.below : found.among);
        return found;
    }
    bool on_ground(const RunEnds::Place& place) const {
        return ends_on_ground(image_,
                              points(place.beyond, [&](const RunEnd& row) { return ends_at(row, place); }),
                              outwards_, width_ + place.beyond, blur_);
    }
    /// The same of the edge itself, where the rows that end at a place outside lie above.
    bool stands_on_ground_below(const RunEnds::Place& place) const {
        int low = 0;
        for (const RunEnd& row : ends_.rows)
            if (ends_at(row, place)) low = std::max(low, row.y);
        const auto below =
            points(0.0, [&](const RunEnd& row) { return ends_.ends_here(row) && row.y > low; });
        return below.size() >= static_cast<std::size_t>(least_rows) &&
               ends_on_ground(image_, below, outwards_, width_, blur_);
    }

  private:
    template <class Chosen>
    std::vector<LinePoint> points(double beyond, const Chosen& chosen) const {
        std::vector<LinePoint> found;
        for (const RunEnd& row : ends_.rows)
            if (chosen(row)) found.push_back({row.y, row.edge + outwards_ * at(row, beyond, width_)});
        return found;
    }
    template <class Chosen>
    std::optional<LumaLine> line(double beyond, const SupposedCylinder& cylinder,
                                 const Chosen& chosen) const {
        return luma_line(image_, points(beyond, chosen), cylinder);
    }

    YuyvView image_;
    const RunEnds& ends_;
    int outwards_;
    double blur_;
    double width_ = 0.0;
};

bool is_absent(const LumaLine& line) {
    return line.chi2 < is_line && line.sigma < faintest_line;
}

bool is_seen(const std::optional<LumaLine>& line) {
    return line && line->chi2 > is_line && line->sigma <= vaguest_line;
}

}  // namespace

RivalVerdict judge_rivals(YuyvView image, const RunEnds& ends, int outwards, const PostStand& stand,
                          double blur) {
    RivalVerdict verdict;
    verdict.here = ends.here();
    if (ends.rows.empty()) return verdict;
    const Judge judge(image, ends, outwards, blur);
    const auto move_to = [&](const RunEnds::Place& place) {
        verdict.moved = place;
        verdict.undecided = place.rows;  // until it is
        std::vector<RunEnd> shown;
        for (const RunEnd& row : ends.rows)
            if (judge.ends_at(row, place)) shown.push_back(row);
        verdict.at = shown[shown.size() / 2];
        verdict.at->beyond = at(*verdict.at, place.beyond, judge.width());
        for (const RunEnd& row : ends.rows)
            if (std::abs(row.beyond) < std::abs(row.beyond - place.beyond) || row.beyond * place.beyond < 0.0)
                for (int k = 0; k < ends.step; ++k) verdict.left_out.push_back(row.y + k);
    };

    const RunEnds::Place inside = ends.inside(), outside = ends.outside(), far_outside = ends.far_outside();
    // A nearer, wider post of which the colour ends at its top where this one's would go on above it.
    for (const RunEnds::Place& place : {outside, far_outside}) {
        if (stand.overtops && judge.counts(place, verdict.here) && stand.reaches(judge.wider(place))) {
            move_to(place);
            return verdict;
        }
    }

    // Nearer by, a wide blur or a colour that is not quite the post's may do it, in any row.
    const auto doubtful = [&](const RunEnds::Place& place) {
        const double away = std::abs(place.beyond);
        if (away <= 0.5 + 1.6 * blur) return 0;
        if (away > 2.0 * ends.tolerance) return place.rows;
        const auto order = judge.order(place);
        return order.above + order.below > mostly * order.among ? place.rows : 0;
    };
    if (judge.counts(inside, verdict.here)) {
        // Down at its foot nothing stands behind a post.
        const auto order = judge.order(inside);
        const auto line = judge.line_about(inside);
        if (order.below >= least_rows &&
            ((line && line->chi2 > is_line) ||
             (order.below >= mostly * (order.above + order.among) && judge.on_ground(inside)))) {
            move_to(inside);
            return verdict;
        }
        if (!line || !is_absent(*line)) verdict.undecided += doubtful(inside);
    }
    if (judge.counts(outside, verdict.here) && !judge.stands_on_ground_below(outside)) {
        const auto line = judge.line_at_edge(outside);
        const double wider = judge.wider(outside);
        const double top = stand.crossbar_row(stand.reaches(wider) ? wider : 1.0).value_or(image.height);
        const auto below_top =
            static_cast<double>(std::count_if(ends.rows.begin(), ends.rows.end(), [&](const RunEnd& row) {
                return judge.ends_at(row, outside) && row.y >= top;
            }));
        const double most = below_top >= many_outside * verdict.here ? is_line : is_none;
        const bool no_line = line && is_absent(*line) && line->chi2 < most && below_top >= least_outside &&
                             below_top >= enough_outside * verdict.here;
        if (no_line || (stand.sinks && !(line && line->chi2 > is_line)))
            move_to(outside);
        else if (!is_seen(line))
            verdict.undecided += doubtful(outside);
    }
    if (!verdict.moved && judge.counts(far_outside, verdict.here) &&
        !is_seen(judge.line_at_edge(far_outside)))
        verdict.undecided += far_outside.rows;
    return verdict;
}

}  // namespace goalmouth
