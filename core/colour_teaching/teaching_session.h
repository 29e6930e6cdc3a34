#pragma once

#include "core/colour_teaching/colour_mark.h"
#include "core/colour_teaching/taught_table.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace goalmouth {

/// A mark and the pixels it covers.
struct SessionMark {
    ColourMark mark;
    MarkedPixels pixels;
    std::vector<CountedColour> colours;
};

/// Pictures that a person marks, one step at a time, and the table that the marks make: each pixel a mark
/// covers is a sample of its class, as often as marks cover it. Steps can be taken back and made again.
class TeachingSession {
  public:
    /// `bits` an axis of the table; `marks` to go on from, which no undo takes back. Throws as add().
    explicit TeachingSession(std::vector<YuyvImage> pictures, int bits = 6,
                             const std::vector<ColourMark>& marks = {});

    std::size_t pictures() const { return pictures_.size(); }
    YuyvView picture(std::size_t i) const { return pictures_[i].view(); }

    /// In the order they were made.
    using Marks = std::vector<std::shared_ptr<const SessionMark>>;
    const Marks& marks() const { return steps_[now_]; }

    // Each of these is one step. They return whether anything changed.

    /// Throws std::invalid_argument for a picture that is not there and for a shape it cannot have.
    bool add(const ColourMark& mark);
    bool remove(std::size_t mark);
    /// All marks of a class, in all pictures.
    bool remove_class(Colour colour);

    /// The picture that the step taken back or made again was about; nothing where there is none.
    std::optional<std::size_t> undo();
    std::optional<std::size_t> redo();

    /// The mark that covers this pixel, the newest of several.
    std::optional<std::size_t> mark_at(std::size_t picture, cv::Point pixel) const;

    /// Pixels marked of each class.
    std::array<std::size_t, colour_count> samples() const;

    /// Nothing where no class but unclassified is marked. A new one for each change.
    const std::optional<ColourTable>& table() const;
    /// Why the marks make no table to use, a sentence; "" where they do.
    std::string problem() const;

    /// Whether the marks are others than when keep() was called last, or than at the beginning.
    bool changed() const;
    void keep() { kept_ = marks(); }

  private:
    std::shared_ptr<const SessionMark> made(const ColourMark& mark) const;
    bool step(Marks marks);
    std::optional<std::size_t> go_to(std::size_t step);
    void expect_table() const;

    std::vector<YuyvImage> pictures_;
    int bits_;
    std::vector<Marks> steps_{{}};
    std::size_t now_ = 0;
    Marks kept_;
    mutable bool has_table_ = false;  // table_ and clash_ are those of the marks
    mutable std::optional<ColourTable> table_;
    mutable std::string clash_;
};

}  // namespace goalmouth
