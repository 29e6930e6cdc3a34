#pragma once

#include "core/extraction/border.h"
#include "core/imaging/colour_gains.h"
#include "core/imaging/colour_table.h"
#include "core/imaging/yuyv.h"
#include "core/parameters/parameters.h"

#include <cstdint>
#include <optional>

#include <Eigen/Core>

namespace goalmouth {

struct LightTrackerParameters {
    double least_area = 0.1;
    double least_field = 0.5;
    int reference_looks = 10;
    double time_constant = 1.0;
    double largest_step = 0.35;
    double jump_after = 1.5;
    double lowest = 0.05;
    double highest = 10.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, LightTrackerParameters& p) {
    v("least_area", p.least_area, Range{0, 1}, "1",
      "a look at the field needs that share of the picture below the field's border");
    v("least_field", p.least_field, Range{0, 1}, "1",
      "and that share of it in the field's colour by the table as it is adapted now, else nothing changes");
    v("reference_looks", p.reference_looks, Range{1, 10000}, "1",
      "looks at the start from which the field's colour is taken that belongs to the table");
    v("time_constant", p.time_constant, Range{0, 1000}, "s", "how slowly the gains follow; 0: at once");
    v("largest_step", p.largest_step, Range{0.01, 10}, "1",
      "looks whose gains differ by a larger share from those in force are not believed at first");
    v("jump_after", p.jump_after, Range{0.1, 3600}, "s",
      "but once they have agreed with each other for so long: a lamp was switched");
    v("lowest", p.lowest, Range{0.05, 1}, "1", "gains never fall below this");
    v("highest", p.highest, Range{1, 20}, "1", "gains never rise above this");
}

/// What the field looks like in one frame.
struct FieldLook {
    Eigen::Vector3d rgb = Eigen::Vector3d::Zero();  // levels, medians; exact to a level
};

/// The field below its border, where it is sure to be field: medians over what may be the same surface as
/// most of what `table` calls field, whether it calls it field or nothing. Nothing where too little of the
/// picture lies below the border, or too little of that has the field's colour.
std::optional<FieldLook> look_at_field(YuyvView image, const FieldBorder& border, const ColourTable& table,
                                       const LightTrackerParameters& parameters);

/// Follows changes of light by the field's look. The first looks say what belongs to the table; from then on
/// each look's ratio to them pulls the gains towards itself. What differs much is believed only once it has
/// lasted. A frame without a look changes nothing, however long that lasts.
class LightTracker {
  public:
    explicit LightTracker(const LightTrackerParameters& parameters) : parameters_(parameters) {}

    /// In order of time; a look that is not younger than the last one counts as the same moment. Returns
    /// whether the gains moved.
    bool follow(const FieldLook& look, std::int64_t utime);
    /// The same for what may be the field (search_field()): believed only once such looks have agreed for
    /// `jump_after`.
    bool suspect(const FieldLook& look, std::int64_t utime);

    const ColourGains& gains() const { return gains_; }
    bool has_reference() const { return looks_ >= parameters_.reference_looks; }
    const Eigen::Vector3d& reference() const { return reference_; }  // levels, once there is one
    int disbelieved() const { return disbelieved_; }

  private:
    struct Suspicion {
        Eigen::Vector3d rgb;       // the last look
        std::int64_t first, last;  // µs
    };
    /// By `pull` of the way to what the look says, unless that differs by more than `largest_step`.
    bool move(const FieldLook& look, double pull, double largest_step);

    LightTrackerParameters parameters_;
    Eigen::Vector3d reference_ = Eigen::Vector3d::Zero();  // mean of the first looks
    int looks_ = 0;
    int disbelieved_ = 0;
    std::int64_t last_ = 0;  // µs
    std::optional<Suspicion> suspected_;
    ColourGains gains_;
};

}  // namespace goalmouth
