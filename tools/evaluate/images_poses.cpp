#include "tools/evaluate/images_poses.h"

#include "core/process/configuration.h"
#include "core/process/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string_view>

namespace goalmouth {
namespace {

struct Quantity {
    const char* name;
    double Pose2::*coordinate;
    double RobotPlace::*angle;
    bool length;  // else an angle
    bool needed;
};

constexpr std::array<Quantity, 5> quantities{
    {{"x", &Pose2::x, nullptr, true, true},
     {"y", &Pose2::y, nullptr, true, true},
     {"heading", &Pose2::theta, nullptr, false, true},
     {"head_yaw", nullptr, &RobotPlace::head_yaw, false, false},
     {"head_pitch", nullptr, &RobotPlace::head_pitch, false, false}}};

struct Unit {
    const char* name;
    double size;  // in m or rad
    bool length;
};

constexpr std::array<Unit, 5> units{{{"m", 1.0, true},
                                     {"cm", 0.01, true},
                                     {"mm", 0.001, true},
                                     {"deg", std::numbers::pi / 180.0, false},
                                     {"rad", 1.0, false}}};

std::vector<std::string> valid_names() {
    std::vector<std::string> names;
    for (const Quantity& quantity : quantities)
        for (const Unit& unit : units)
            if (unit.length == quantity.length) names.push_back(std::string(quantity.name) + "_" + unit.name);
    return names;
}

/// The number `text` begins with, which is taken off.
std::optional<double> take_number(std::string_view& text) {
    std::string_view rest = text;
    if (!rest.empty() && rest.front() == '+') {
        rest.remove_prefix(1);
        if (!rest.empty() && rest.front() == '-') return std::nullopt;
    }
    double number = 0.0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
    text = rest.substr(static_cast<std::size_t>(end - rest.data()));
    return number;
}

}  // namespace

PlacePattern::PlacePattern(const std::string& text) : text_(text) {
    std::size_t at = 0;
    for (std::size_t open = 0; (open = text.find_first_of("{}", at)) != std::string::npos;) {
        const std::size_t close = text[open] == '{' ? text.find_first_of("{}", open + 1) : std::string::npos;
        if (close == std::string::npos || text[close] != '}')
            throw ConfigurationError("pattern \"" + text + "\": a brace has no counterpart");
        add_piece(text.substr(at, open - at), text.substr(open + 1, close - open - 1));
        at = close + 1;
    }
    end_ = text.substr(at);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const bool last = i + 1 == pieces_.size();
        pieces_[i].other_than = pieces_[i].literal + (last ? end_ : pieces_[i + 1].literal);
    }
    for (const Quantity& quantity : quantities) {
        const bool there = std::any_of(pieces_.begin(), pieces_.end(), [&](const Piece& piece) {
            return quantity.coordinate != nullptr && piece.coordinate == quantity.coordinate;
        });
        if (quantity.needed && !there) {
            throw ConfigurationError("pattern \"" + text + "\": " + quantity.name + " is missing, such as {" +
                                     quantity.name + (quantity.length ? "_cm}" : "_deg}"));
        }
    }
}

void PlacePattern::add_piece(const std::string& literal, const std::string& inside) {
    const std::string where = "pattern \"" + text_ + "\": ";
    if (literal.empty() && !pieces_.empty()) {
        throw ConfigurationError(where + "nothing stands before {" + inside +
                                 "}, so that nobody can tell where the piece before it ends");
    }
    Piece piece{literal, {}, nullptr, nullptr, 0.0};
    if (!inside.empty()) {
        for (const Quantity& quantity : quantities) {
            for (const Unit& unit : units) {
                if (unit.length != quantity.length || inside != std::string(quantity.name) + "_" + unit.name)
                    continue;
                piece.angle = quantity.angle;
                piece.coordinate = quantity.coordinate;
                piece.unit = unit.size;
            }
        }
        if (piece.unit == 0.0)
            throw ConfigurationError(where + "unknown {" + inside + "}; " +
                                     suggestion(inside, valid_names()) + "; {} is anything");
        if (std::any_of(pieces_.begin(), pieces_.end(), [&](const Piece& other) {
                return other.unit != 0.0 && other.angle == piece.angle &&
                       other.coordinate == piece.coordinate;
            }))
            throw ConfigurationError(where + "{" + inside + "} is there twice");
    }
    pieces_.push_back(piece);
}

std::optional<RobotPlace> PlacePattern::place(const std::string& file) const {
    const std::string name = std::filesystem::path(file).stem().string();
    std::string_view rest = name;
    RobotPlace place;
    for (const Piece& piece : pieces_) {
        if (!rest.starts_with(piece.literal)) return std::nullopt;
        rest.remove_prefix(piece.literal.size());
        if (piece.unit == 0.0) {
            rest.remove_prefix(std::min(rest.size(), rest.find_first_of(piece.other_than)));
            continue;
        }
        const auto number = take_number(rest);
        if (!number) return std::nullopt;
        double& value = piece.coordinate != nullptr ? place.feet.*piece.coordinate : place.*piece.angle;
        value = *number * piece.unit;
    }
    if (rest != end_) return std::nullopt;
    return place;
}

std::string PlacePattern::example() const {
    std::string name;
    for (const Piece& piece : pieces_) name += piece.literal + (piece.unit == 0.0 ? "a" : "12.5");
    return name + end_ + ".png";
}

}  // namespace goalmouth
