#include "core/colour_teaching/teaching_session.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace goalmouth {

TeachingSession::TeachingSession(std::vector<YuyvImage> pictures, int bits,
                                 const std::vector<ColourMark>& marks)
    : pictures_(std::move(pictures)), bits_(bits) {
    for (const ColourMark& mark : marks) steps_.front().push_back(made(mark));
    keep();
}

std::shared_ptr<const SessionMark> TeachingSession::made(const ColourMark& mark) const {
    if (mark.picture >= pictures_.size()) throw std::invalid_argument("there is no such picture");
    const YuyvView view = picture(mark.picture);
    const MarkedPixels pixels = marked_pixels(mark.shape, view);
    return std::make_shared<SessionMark>(SessionMark{mark, pixels, colours_of(pixels, view)});
}

bool TeachingSession::add(const ColourMark& mark) {
    Marks all = marks();
    all.push_back(made(mark));
    return step(std::move(all));
}

bool TeachingSession::remove(std::size_t mark) {
    Marks all = marks();
    if (mark >= all.size()) return false;
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(mark));
    return step(std::move(all));
}

bool TeachingSession::remove_class(Colour colour) {
    Marks all = marks();
    std::erase_if(all, [&](const auto& each) { return each->mark.colour == colour; });
    return step(std::move(all));
}

bool TeachingSession::step(Marks marks) {
    if (marks == this->marks()) return false;
    steps_.resize(now_ + 1);
    steps_.push_back(std::move(marks));
    ++now_;
    has_table_ = false;
    return true;
}

std::optional<std::size_t> TeachingSession::undo() {
    return now_ == 0 ? std::nullopt : go_to(now_ - 1);
}

std::optional<std::size_t> TeachingSession::redo() {
    return now_ + 1 == steps_.size() ? std::nullopt : go_to(now_ + 1);
}

std::optional<std::size_t> TeachingSession::go_to(std::size_t step) {
    const Marks& from = steps_[now_];
    const Marks& to = steps_[step];
    now_ = step;
    has_table_ = false;
    const Marks& longer = from.size() > to.size() ? from : to;
    const Marks& shorter = from.size() > to.size() ? to : from;
    // The first that only one of the two has.
    const auto differs = std::mismatch(longer.begin(), longer.begin() + std::ssize(shorter), shorter.begin());
    return (*differs.first)->mark.picture;
}

std::optional<std::size_t> TeachingSession::mark_at(std::size_t picture, cv::Point pixel) const {
    for (std::size_t i = marks().size(); i-- > 0;)
        if (marks()[i]->mark.picture == picture && marks()[i]->pixels.holds(pixel)) return i;
    return std::nullopt;
}

std::array<std::size_t, colour_count> TeachingSession::samples() const {
    std::array<std::size_t, colour_count> counts{};
    for (const auto& each : marks())
        counts[static_cast<std::size_t>(each->mark.colour)] += pixels_of(each->colours);
    return counts;
}

void TeachingSession::expect_table() const {
    if (has_table_) return;
    ClassSamples samples;
    for (const auto& each : marks()) {
        auto& of_class = samples[static_cast<std::size_t>(each->mark.colour)];
        of_class.insert(of_class.end(), each->colours.begin(), each->colours.end());
    }
    table_ = taught_table(samples, bits_, "");
    clash_ = table_ ? clash_of_classes(samples, *table_) : "";
    has_table_ = true;
}

const std::optional<ColourTable>& TeachingSession::table() const {
    expect_table();
    return table_;
}

std::string TeachingSession::problem() const {
    expect_table();
    if (marks().empty()) return "nothing is marked";
    if (!table_) return "all marks are unclassified; a table needs one of a class at least";
    return clash_;
}

bool TeachingSession::changed() const {
    return marks() != kept_;
}

}  // namespace goalmouth
