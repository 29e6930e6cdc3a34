#include "core/detection/upright_evidence.h"

#include "core/geometry/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace goalmouth {
namespace {

// What a row within a post's ends counts.
constexpr double both_edges = 2.0, one_edge = 1.0, ends_early = 0.5, no_edge = -0.3, hidden = -0.8,
                 hidden_top = -1.5;
// What it counts besides where all between the edges is field.
constexpr double shows_field = -3.0;
// And one beyond them.
constexpr double goes_on_beside = -0.75, goes_on = -5.0, hangs = -0.3;

/// Slopes of the rows along an upright line: followed in a few of them, a parabola in between.
template <class Rows>
void set_slopes(const std::vector<int>& pixel_rows, const UprightView& view, const UprightEdges& edges,
                Rows& rows) {
    double near = 0.0;  // px, column of the line in the row before
    if (const auto level = view.pixel({edges.middle(0.0), 0.0})) near = level->x();
    const auto slope_in = [&](int y) {
        double slope = 0.0;
        for (int round = 0; round < 2; ++round) {
            slope = view.ray({near, static_cast<double>(y)}).slope;
            const auto there = view.pixel({edges.middle(slope), slope});
            if (!there) break;
            near = there->x();
        }
        return slope;
    };
    constexpr std::size_t stretches = 4;
    const std::size_t last = rows.size() - 1;
    double at_start = slope_in(pixel_rows.front());
    for (std::size_t k = 0; k < stretches; ++k) {
        const std::size_t from = last * k / stretches, to = last * (k + 1) / stretches;
        rows[from].slope = at_start;
        if (to == from) continue;
        const double y0 = pixel_rows[from], y2 = pixel_rows[to];
        const std::size_t middle = (from + to) / 2;
        const double y1 = pixel_rows[middle];
        const double at_middle = middle > from ? slope_in(pixel_rows[middle]) : at_start;
        const double at_end = slope_in(pixel_rows[to]);
        for (std::size_t i = from + 1; i <= to; ++i) {
            const double y = pixel_rows[i];
            double slope = at_start + (at_end - at_start) * (y - y0) / (y2 - y0);
            if (middle > from) {
                const double bow = at_middle - at_start - (at_end - at_start) * (y1 - y0) / (y2 - y0);
                slope += bow * (y - y0) * (y2 - y) / ((y1 - y0) * (y2 - y1));
            }
            rows[i].slope = slope;
        }
        at_start = at_end;
    }
}

}  // namespace

void UprightJudge::look(const UprightCandidates& candidates, const UprightView& view,
                        const UprightEdges& edges, double tolerance) {
    rows_.assign(candidates.rows.size(), {});
    set_slopes(candidates.rows, view, edges, rows_);
    const auto mark = [&](const std::vector<UprightPoint>& points, double azimuth, bool Row::*edge) {
        for (const UprightPoint& p : points)
            if (p.row >= 0 && std::abs(p.ray.azimuth - azimuth - edges.roll * p.ray.slope) < tolerance)
                rows_[static_cast<std::size_t>(p.row)].*edge = true;
    };
    mark(candidates.left, edges.left, &Row::left);
    mark(candidates.right, edges.right, &Row::right);
    const double width = edges.right - edges.left;
    for (const UprightRun& run : candidates.runs) {
        const double begin = run.start.azimuth - edges.roll * run.start.slope - edges.left;
        const double end = run.end.azimuth - edges.roll * run.end.slope - edges.left;
        const double overlap = std::min(end, width) - std::max(begin, 0.0);
        if (!(overlap > 0.0) || overlap < 0.5 * width) continue;
        if (run.row < 0) continue;
        Row& row = rows_[static_cast<std::size_t>(run.row)];
        row.covered = true;
        row.reaches_left = row.reaches_left || run.cut_left || begin <= tolerance;
        row.reaches_right = row.reaches_right || run.cut_right || end >= width - tolerance;
        row.cut =
            row.cut || (run.cut_left && begin > -tolerance) || (run.cut_right && end < width + tolerance);
    }
    const double between = width - 2.0 * tolerance;
    for (const UprightRun& run : candidates.field) {
        if (run.row < 0 || !(between > 0.0)) continue;
        const double begin = run.start.azimuth - edges.roll * run.start.slope - edges.left;
        const double end = run.end.azimuth - edges.roll * run.end.slope - edges.left;
        const double overlap = std::min(end, width - tolerance) - std::max(begin, tolerance);
        if (overlap > 0.0) rows_[static_cast<std::size_t>(run.row)].field += overlap / between;
    }
}

UprightJudge::Horizon UprightJudge::horizon_of(const UprightCandidates& candidates, const UprightView& view,
                                               const UprightEdges& edges, double distance) const {
    Horizon horizon;
    if (candidates.border.empty()) return horizon;
    horizon.border = chain_y_at(candidates.border, edges.middle(0.0));
    constexpr double heights = 2.0, doubt = 0.1;  // green things behind the field raise its border
    if (!view.height()) horizon.deepest_base = horizon.border - heights * size_.height / distance - doubt;
    return horizon;
}

UprightEvidence UprightJudge::judge(const UprightCandidates& candidates, const UprightView& view,
                                    const UprightEdges& edges, double tolerance) {
    UprightEvidence best;
    if (candidates.rows.size() < 2 || !(edges.half_angle() > 0.0)) return best;
    look(candidates, view, edges, tolerance);
    const std::size_t n = rows_.size();
    inside_.assign(n + 1, 0.0);
    outside_.assign(n + 1, 0.0);
    const auto first_seen = static_cast<std::size_t>(
        std::find_if(rows_.begin(), rows_.end(),
                     [](const Row& row) { return row.covered && (row.left || row.right); }) -
        rows_.begin());
    for (std::size_t i = 0; i < n; ++i) {
        const Row& row = rows_[i];
        const int seen = static_cast<int>(row.left) + static_cast<int>(row.right);
        double in = i < first_seen ? hidden_top : hidden, out = 0.0;
        if (row.covered) {
            const bool ends = row.left ? !row.reaches_right : !row.reaches_left;
            in = seen == 2 ? both_edges : seen == 0 ? no_edge : ends ? ends_early : one_edge;
            if (row.cut) in = std::max(in, 0.5 * one_edge) + 0.5 * one_edge;
            out = seen == 2 ? goes_on : seen == 1 ? goes_on_beside : 0.0;
        }
        in += shows_field * std::min(1.0, row.field);
        inside_[i + 1] = inside_[i] + in;
        outside_[i + 1] = outside_[i] + out;
    }
    // Rows run down the picture, slopes fall.
    const auto row_below = [&](double slope) {
        return static_cast<std::size_t>(
            std::lower_bound(rows_.begin(), rows_.end(), slope,
                             [](const Row& row, double s) { return row.slope > s; }) -
            rows_.begin());
    };
    const double distance = size_.radius / std::sin(edges.half_angle());
    const double near = std::max(0.5 * distance, distance - size_.radius);
    const double height = view.height().value_or(0.5 * size_.height);
    const Horizon horizon = horizon_of(candidates, view, edges, near);
    // Two rows of doubt, for the line along the border.
    const std::size_t border = std::max<std::size_t>(row_below(horizon.border), 2) - 2;
    const double rise = size_.height - height;
    const double base = -height / near;
    const double top = rise / (rise > 0.0 ? near : distance + size_.radius);
    const double sigma =
        view.height() ? view.attitude_sigma() : std::hypot(view.attitude_sigma(), 0.25 * (top - base));
    // Where it stands is known as well as the attitude; how high a goal is, less.
    const double base_margin = 0.04 * (top - base), margin = 0.1 * (top - base);
    constexpr double sigmas = 2.5;
    const double step = std::max(0.25 * margin, sigmas * sigma / 100.0);
    if (!(step > 0.0) || !std::isfinite(step)) return best;
    const int steps = static_cast<int>(sigmas * sigma / step);
    bool first = true;
    for (int k = -steps; k <= steps; ++k) {
        const double shift = k * step;
        const double middle = 0.5 * (top + base) + shift;
        const double stretch = 1.0 + middle * middle;  // a turn moves slopes by 1 + t²
        const double at_top = top + shift * stretch, at_base = base + shift * stretch;
        const std::size_t begin = row_below(at_top), end = row_below(at_base);
        if (end <= begin || at_base < horizon.deepest_base) continue;
        const std::size_t above = row_below(at_top + margin), below = row_below(at_base - base_margin);
        const double score = inside_[end] - inside_[begin] + outside_[above] + outside_[n] - outside_[below] +
                             (border > end ? hangs * static_cast<double>(border - end) : 0.0) -
                             cost_of_error(shift, sigma);
        if (!first && score <= best.score) continue;
        first = false;
        best = {};
        best.score = score;
        best.rows = static_cast<double>(end - begin);
        best.first_slope = at_top;
        best.last_slope = at_base;
    }
    if (first) return best;
    const std::size_t begin = row_below(best.first_slope + margin),
                      end = row_below(best.last_slope - base_margin);
    const std::size_t ground = row_below(best.last_slope);
    bool any = false;
    std::size_t last = end;
    for (std::size_t i = begin; i < end; ++i) {
        const Row& row = rows_[i];
        if (!row.covered) continue;
        if (!any) best.first_slope = row.slope;
        best.last_slope = row.slope;
        any = true;
        last = i;
        ++best.covered_rows;
        best.left_rows += row.left ? 1 : 0;
        best.right_rows += row.right ? 1 : 0;
    }
    if (!any || !view.height()) return best;
    for (std::size_t i = last + 1; i < ground && !(rows_[i].field > 0.0); ++i)
        best.last_slope = rows_[i].slope;
    return best;
}

}  // namespace goalmouth
