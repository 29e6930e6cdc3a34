#pragma once

#include <array>
#include <optional>
#include <string>

namespace goalmouth {

/// What the paper measured, with its camera and its posts (section 6; the RMSEs are those of its text).
struct PaperFigures {
    std::string detector;
    std::array<std::optional<double>, 3> rmse_cm;  // by cell_tilts_deg, where it says
    std::string detection;
    std::string fewest_found;  // the same in a few letters, for tables
};

/// By the name of a detector, nothing for those it does not know.
inline std::optional<PaperFigures> paper_figures(const std::string& detector) {
    if (detector == "histogram")
        return PaperFigures{detector, {157.9, std::nullopt, 290.9}, "falls to 1 % at 6 m", "600 cm: 1 %"};
    if (detector == "ransac")
        return PaperFigures{detector,
                            {19.64, std::nullopt, 30.94},
                            "near perfect, whatever the tilt or the distance",
                            "near perfect"};
    return std::nullopt;
}

inline constexpr int paper_frames = 3600;
inline constexpr const char* paper_source =
    "Flannery, Fenn, Budden: RANSAC: Identification of Higher-Order Geometric Features and Applications in "
    "Humanoid Robot Soccer; photographs by a Logitech C905 in a DARwIn-OP";

}  // namespace goalmouth
