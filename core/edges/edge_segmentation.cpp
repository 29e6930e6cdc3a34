#include "core/edges/edge_segmentation.h"

#include "core/edges/frame_scale.h"
#include "core/edges/pair_mean.h"
#include "core/edges/post_rules.h"
#include "core/edges/strip_growth.h"
#include "core/segmentation/label_changes.h"
#include "core/segmentation/pixel_labels.h"

#include <algorithm>
#include <cmath>
#include <hwy/cache_control.h>

namespace goalmouth {
namespace {

/// The survey looks at about so many scan-lines, evenly spread, and there at so many pairs.
constexpr std::size_t survey_rows = 24;
constexpr int survey_pairs = 48;

/// Memory is asked for so many rows of the layout before their turn.
constexpr std::size_t rows_ahead = 2;

/// A chain begins with a surface at least this share as bright as a post has to be: one part of it may lie in
/// shade.
constexpr double share_of_brightness = 0.7;
/// and a stretch that both its edges show this share.
constexpr double share_of_mean_brightness = 0.9;

/// Posts do not touch: what shares an edge with another strip is what lies behind that one.
bool touch(const UprightStrip& a, const UprightStrip& b) {
    const double top = std::max(a.top(), b.top());
    const double base = std::min(a.base(), b.base());
    if (base < top) return false;
    const double y = 0.5 * (top + base);
    const double apart = std::max(a.left.at(y), b.left.at(y)) - std::min(a.right.at(y), b.right.at(y));
    return apart < 0.5 * std::min(a.width_at(y), b.width_at(y));
}

/// Whether growing a seed would only make a strip anew: its middle lies in one that is a post, or its edges
/// lie on those of any.
bool known(const StripSeed& seed, const FrameEdges& frame, const JudgedStrip& judged, double straightness) {
    const UprightStrip& strip = judged.strip;
    const double y = 0.5 * (frame.y(seed.first_row) + frame.y(seed.last_row));
    if (y < strip.top() || y > strip.base()) return false;
    const double left = seed.left.at(y) - strip.left.at(y);
    const double right = seed.right.at(y) - strip.right.at(y);
    if (std::abs(left) <= straightness && std::abs(right) <= straightness) return true;
    const double x = 0.5 * (seed.left.at(y) + seed.right.at(y));
    return judged.refused.empty() && x > strip.left.at(y) && x < strip.right.at(y);
}

/// Appends a line's segments one by one.
class LineWriter {
  public:
    LineWriter(Segments& out, Orientation orientation, int position) : out_(out) {
        line_ = {orientation, position, static_cast<int>(out.segments.size()), 0};
    }
    /// From pixel `start` on the line is of that colour; `transition` as Segment has it.
    void change(int start, Colour colour, float transition) {
        if (line_.count > 0) {
            Segment& last = out_.segments.back();
            if (last.colour == colour) return;
            if (start <= last.start) {
                last.colour = colour;
                return;
            }
            last.end = static_cast<std::int16_t>(start - 1);
        }
        // What a segments_t holds: hundredths of a pixel, no more than 127 of them.
        const float nominal = static_cast<float>(start) - 0.5F;
        const float offset = std::clamp(std::round(100.F * (transition - nominal)), -127.F, 127.F) / 100.F;
        out_.segments.push_back({static_cast<std::int16_t>(start), 0, colour, nominal + offset});
        ++line_.count;
    }
    void change(int start, Colour colour) { change(start, colour, static_cast<float>(start) - 0.5F); }
    void end(int length) {
        out_.segments.back().end = static_cast<std::int16_t>(length - 1);
        out_.lines.push_back(line_);
    }

  private:
    Segments& out_;
    ScanLine line_;
};

}  // namespace

EdgeSegmenter::EdgeSegmenter(const EdgeSegmentationParameters& parameters)
    : parameters_(parameters),
      left_finder_(parameters.posts),
      right_finder_(parameters.posts),
      seed_finder_(parameters.posts) {}

const Segments& EdgeSegmenter::segment(YuyvView image, const ScanLayout& layout,
                                       const CameraOverGround* view) {
    segments_.clear();
    segments_.width = image.width;
    segments_.height = image.height;
    frame_.rows.clear();
    frame_.edges.clear();
    frame_.first.clear();
    columns_.clear();
    strips_.clear();
    runs_.clear();
    field_.reset();
    if (image.empty()) return segments_;
    for (const int y : layout.rows)
        if (y >= 0 && y < image.height) frame_.rows.push_back(y);
    for (const int x : layout.columns)
        if (x >= 0 && x < image.width) columns_.push_back(x);

    survey(image);
    find_edges(image);
    if (field_ && !ground_.empty()) find_posts(image, view);
    write_rows(image);
    write_columns(image);
    return segments_;
}

void EdgeSegmenter::survey(YuyvView image) {
    const EdgeParameters& edges = parameters_.edges;
    threshold_.window = window_pairs(edges, image.width);
    threshold_.chroma_weight = static_cast<float>(edges.chroma_weight);
    samples_.clear();
    sampled_steps_.clear();
    const std::size_t rows_apart = std::max<std::size_t>(1, frame_.rows.size() / survey_rows);
    for (std::size_t row = rows_apart / 2; row < frame_.rows.size(); row += rows_apart) {
        row_.load(image, frame_.rows[row], frame_.rows[std::min(row + rows_apart, frame_.rows.size() - 1)]);
        const auto steps = row_.squared_steps(threshold_.window, threshold_.chroma_weight);
        const float down = static_cast<float>(frame_.rows[row] + 1) / static_cast<float>(image.height);
        const int pairs_apart = std::max(1, row_.pairs() / survey_pairs);
        for (int i = threshold_.window; i + threshold_.window <= row_.pairs(); i += pairs_apart) {
            samples_.push_back({row_.mean(i, i + 1), down});
            sampled_steps_.push_back(steps[static_cast<std::size_t>(i)]);
        }
    }
    double noise = 0.0;
    if (!sampled_steps_.empty()) {
        const auto median = sampled_steps_.begin() + static_cast<std::ptrdiff_t>(sampled_steps_.size() / 2);
        std::nth_element(sampled_steps_.begin(), median, sampled_steps_.end());
        noise = std::sqrt(static_cast<double>(*median));
    }
    threshold_.strength = static_cast<float>(std::max(edges.least_strength, edges.noise_factor * noise));
    field_ = field_finder_.find(samples_, static_cast<float>(parameters_.field.least_share));
}

void EdgeSegmenter::find_edges(YuyvView image) {
    ground_.begin(image, frame_.rows, columns_);
    for (std::size_t row = 0; row < frame_.rows.size(); ++row) {
        frame_.first.push_back(frame_.edges.size());
        row_.load(image, frame_.rows[row], frame_.rows[std::min(row + rows_ahead, frame_.rows.size() - 1)]);
        find_row_edges(row_, threshold_, field_, frame_.edges);
        if (field_) ground_.add_row(*field_);
    }
    frame_.first.push_back(frame_.edges.size());
    ground_.finish();
}

void EdgeSegmenter::find_posts(YuyvView image, const CameraOverGround* view) {
    const StripParameters& posts = parameters_.posts;
    const double straightness = straightness_px(posts, image.width);
    const auto darkest = static_cast<float>(share_of_brightness * posts.least_brightness) * field_->luma();
    const auto darkest_mean =
        static_cast<float>(share_of_mean_brightness * posts.least_brightness) * field_->luma();
    const auto left = left_finder_.find(frame_, ChainSide::left, threshold_, straightness, darkest);
    const auto right = right_finder_.find(frame_, ChainSide::right, threshold_, straightness, darkest);
    for (const StripSeed& seed :
         seed_finder_.find(frame_, left, right, threshold_.chroma_weight, straightness, image.width)) {
        if (seed.inside.y < darkest_mean) continue;
        if (std::any_of(strips_.begin(), strips_.end(),
                        [&](const JudgedStrip& s) { return known(seed, frame_, s, straightness); }))
            continue;
        JudgedStrip judged{grow_strip(image, frame_, seed, posts, threshold_, straightness, stretch_), ""};
        if (judged.strip.rows.empty()) continue;
        judged.refused = why_no_post(judged.strip, frame_, ground_, *field_, posts, threshold_, straightness,
                                     image.width, image.height, view)
                             .value_or("");
        strips_.push_back(std::move(judged));
    }
    // Of strips that touch the most distinct one stays.
    const auto merit = [](const UprightStrip& s) { return s.both * s.contrast; };
    std::stable_sort(strips_.begin(), strips_.end(), [&](const JudgedStrip& a, const JudgedStrip& b) {
        return merit(a.strip) > merit(b.strip);
    });
    for (std::size_t i = 0; i < strips_.size(); ++i) {
        if (!strips_[i].refused.empty()) continue;
        for (std::size_t j = 0; j < i; ++j) {
            if (strips_[j].refused.empty() && touch(strips_[i].strip, strips_[j].strip))
                strips_[i].refused = "lies in another or beside it";
        }
        if (!strips_[i].refused.empty()) continue;
        const UprightStrip& strip = strips_[i].strip;
        for (const StripRow& r : strip.rows) {
            // An edge that a row does not show lies where the other rows have it.
            const float from = r.left.value_or(static_cast<float>(strip.left.at(r.y)));
            const float to = r.right.value_or(static_cast<float>(strip.right.at(r.y)));
            if (to - from < 2.F || to < 2.F || from > static_cast<float>(image.width) - 3.F) continue;
            const auto row =
                std::lower_bound(frame_.rows.begin(), frame_.rows.end(), r.y) - frame_.rows.begin();
            runs_.push_back({static_cast<std::size_t>(row), from, to});
        }
    }
    std::sort(runs_.begin(), runs_.end(), [](const GoalRun& a, const GoalRun& b) {
        return a.row != b.row ? a.row < b.row : a.left < b.left;
    });
}

void EdgeSegmenter::write_rows(YuyvView image) {
    const auto first_pixel = [&](float x) {
        return std::clamp(static_cast<int>(std::lround(x + 0.5F)), 1, image.width - 1);
    };
    changed_.resize(columns_.size() + label_margin);
    auto run = runs_.begin();
    for (std::size_t row = 0; row < frame_.rows.size(); ++row) {
        const std::uint8_t* ground = ground_.row(row);
        const std::size_t changes =
            columns_.empty() ? 0 : find_changes(ground, ground + 1, columns_.size() - 1, changed_.data());
        LineWriter line(segments_, Orientation::horizontal, frame_.rows[row]);
        Colour colour = !columns_.empty() && ground[0] != 0 ? Colour::field : Colour::unclassified;
        line.change(0, colour);
        const auto write_run = [&] {
            // What goes on beyond the picture has no edge at its border.
            if (run->left < 0.5F) {
                line.change(0, Colour::goal);
            } else {
                line.change(first_pixel(run->left), Colour::goal, run->left);
            }
            if (run->right < static_cast<float>(image.width) - 1.5F)
                line.change(first_pixel(run->right), colour, run->right);
            ++run;
        };
        const auto of_row = [&] { return run != runs_.end() && run->row == row; };
        for (std::size_t k = 0; k < changes; ++k) {
            const auto c = static_cast<std::size_t>(changed_[k]);
            const int start = (columns_[c] + columns_[c + 1] + 1) / 2;
            while (of_row() && first_pixel(run->right) <= start) write_run();
            colour = colour == Colour::field ? Colour::unclassified : Colour::field;
            if (!of_row() || first_pixel(run->left) > start) line.change(start, colour);
        }
        while (of_row()) write_run();
        line.end(image.width);
    }
}

/// Where the field begins in each column whose border lies between two rows: the first pixel that is the
/// field's, by halves. All columns take their halves together, so that the memory of the next one is on its
/// way.
void EdgeSegmenter::locate_border(YuyvView image) {
    const auto ask_for = [&](const BorderPlace& p) {
        hwy::Prefetch(image.row((p.upper + p.lower) / 2) + 4 * (columns_[p.column] / 2));
    };
    const int last_pair = (image.width - 1) / 2;
    for (const BorderPlace& place : border_) ask_for(place);
    for (bool more = true; more;) {
        more = false;
        for (BorderPlace& place : border_) {
            if (place.lower - place.upper <= 1) continue;
            const int middle = (place.upper + place.lower) / 2;
            const int pair = columns_[place.column] / 2;
            const bool field =
                field_->contains(mean_of_pairs(image.row(middle), pair, std::min(pair + 1, last_pair)));
            (field ? place.lower : place.upper) = middle;
            ask_for(place);
            more = true;
        }
    }
}

void EdgeSegmenter::write_columns(YuyvView image) {
    const std::size_t columns = columns_.size();
    const std::size_t rows = frame_.rows.size();
    constexpr auto goal = static_cast<std::uint8_t>(Colour::goal);
    static_assert(static_cast<int>(Colour::field) == 1 && static_cast<int>(Colour::unclassified) == 0);
    labels_.assign(ground_.row(0), ground_.row(rows) + label_margin);
    for (const GoalRun& run : runs_) {
        const auto begin = std::lower_bound(columns_.begin(), columns_.end(), run.left,
                                            [](int x, float left) { return static_cast<float>(x) < left; });
        for (auto x = begin; x != columns_.end() && static_cast<float>(*x) < run.right; ++x)
            labels_[run.row * columns + static_cast<std::size_t>(x - columns_.begin())] = goal;
    }
    // Row by row, as memory lies, then by column.
    changes_.clear();
    first_change_.assign(columns + 1, 0);
    for (std::size_t row = 1; row < rows; ++row) {
        const std::uint8_t* here = labels_.data() + row * columns;
        const std::size_t count = find_changes(here - columns, here, columns, changed_.data());
        for (std::size_t k = 0; k < count; ++k) {
            const auto column = static_cast<std::size_t>(changed_[k]);
            changes_.push_back({row, column});
            ++first_change_[column + 1];
        }
    }
    for (std::size_t c = 0; c < columns; ++c) first_change_[c + 1] += first_change_[c];
    sorted_.resize(changes_.size());
    for (const ColumnChange& change : changes_) sorted_[first_change_[change.column]++] = change;

    border_.clear();
    const auto label_at = [&](std::size_t row, std::size_t column) {
        return static_cast<Colour>(labels_[row * columns + column]);
    };
    // To the pixel where it matters: where the field begins for the first time, but not behind a post.
    for (std::size_t i = 0; i < sorted_.size(); ++i) {
        const auto& [row, column] = sorted_[i];
        if (label_at(row, column) != Colour::field || label_at(0, column) == Colour::field) continue;
        if (!border_.empty() && border_.back().column == column) continue;
        border_.push_back({column, i, frame_.rows[row - 1], frame_.rows[row]});
    }
    std::erase_if(border_, [&](const BorderPlace& place) {
        const ColumnChange& change = sorted_[place.change];
        return label_at(change.row - 1, change.column) == Colour::goal;
    });
    locate_border(image);

    auto place = border_.begin();
    auto change = sorted_.begin();
    for (std::size_t c = 0; c < columns; ++c) {
        LineWriter line(segments_, Orientation::vertical, columns_[c]);
        line.change(0, rows > 0 ? label_at(0, c) : Colour::unclassified);
        for (; change != sorted_.end() && change->column == c; ++change) {
            int start = (frame_.rows[change->row - 1] + frame_.rows[change->row] + 1) / 2;
            if (place != border_.end() && place->change == static_cast<std::size_t>(change - sorted_.begin()))
                start = (place++)->lower;
            line.change(start, label_at(change->row, c));
        }
        line.end(image.height);
    }
}

}  // namespace goalmouth
