#pragma once

#include "core/imaging/yuyv.h"
#include "core/refinement/whole_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <Eigen/Core>

namespace goalmouth {

/// Luma and chroma of a pair of pixels: (mean Y, Cb − 128, Cr − 128), as the picture has it or, where it says
/// so, of its light.
using PairColour = Eigen::Vector3f;

/// What a camera makes of light.
///
/// Lens and pixels mix the light of post and background in proportion; their levels mix so only if levels are
/// in proportion to light. Of cameras that code light as screens expect it (IEC 61966-2-1, sRGB; BT.601 and
/// BT.709 are much alike) an edge's middle is brighter than midway between its sides, and a dark channel's
/// edge lies farther in: a yellow post before a bright wall looks half a pixel too narrow, which at six
/// metres and 640 px is 6 % of the distance. Where light is worked out of levels first, it does not.
enum class CameraResponse : std::uint8_t { linear, srgb };

/// Light of a level, both 0…1: a cubic through black and white, nowhere more than 0.004 off the standard's
/// curve; its factors from the level's first power on.
float light_of_level(float level);
inline constexpr std::array<float, 3> light_factors = {0.012522878F, 0.682171111F, 0.305306011F};

/// A grey level as pixels of such a response are read, 0…255.
float grey_as_read(float level, CameraResponse response);

/// A row of a picture in pairs of pixels, [Y0 Cb Y1 Cr] each.
///
/// A pair's colour is the mean of its pixels' levels or, 0…255 as well, of their light. The pair's one chroma
/// is the mean of two that differ where light is worked out: as much as from pair to pair about it.
class PairRow {
  public:
    PairRow(const std::uint8_t* row, int pairs, CameraResponse response)
        : row_(row), pairs_(pairs), response_(response) {}

    /// 0 ≤ pair < pairs.
    PairColour operator[](int pair) const {
        const std::uint8_t* p = row_ + 4 * pair;
        if (response_ == CameraResponse::srgb) return light(pair);
        return {0.5F * static_cast<float>(p[0] + p[2]), static_cast<float>(p[1]) - 128.0F,
                static_cast<float>(p[3]) - 128.0F};
    }

    /// Pairs `first` to `last`, in the row, added to a sum.
    void add(int first, int last, PairColour& sum) const {
        if (response_ == CameraResponse::srgb) {
            for (int pair = first; pair <= last; ++pair) sum += light(pair);
            return;
        }
        // Both lumas of a pair, and both chromas, as 16 bits each of one number.
        constexpr int most = 256;  // pairs, of which the sums fit those
        for (int from = first; from <= last; from += most) {
            const int to = std::min(last, from + most - 1);
            std::uint32_t luma = 0, chroma = 0;
            for (int pair = from; pair <= to; ++pair) {
                std::uint32_t bytes = 0;
                std::memcpy(&bytes, row_ + 4 * pair, sizeof(bytes));
                luma += bytes & 0xff00ffU;
                chroma += bytes >> 8 & 0xff00ffU;
            }
            const int none = 128 * (to - from + 1);
            const auto lower = [](std::uint32_t sums) { return static_cast<int>(sums & 0xffffU); };
            const auto upper = [](std::uint32_t sums) { return static_cast<int>(sums >> 16); };
            sum += PairColour(0.5F * static_cast<float>(lower(luma) + upper(luma)),
                              static_cast<float>(lower(chroma) - none),
                              static_cast<float>(upper(chroma) - none));
        }
    }

    /// The pair whose middle is nearest to a column [px], inside the row or not; some pair far outside where
    /// the column is farther than any picture reaches.
    static int pair_at(double column) {
        constexpr double far = 1e6;                                                 // px
        return nearest_whole(0.5 * (std::min(far, std::max(-far, column)) - 0.5));  // NaN: −far
    }

  private:
    PairColour light(int pair) const;

    const std::uint8_t* row_;
    int pairs_;
    CameraResponse response_;
};

/// The level that light of a colour is coded as, or the light of such a level: (Y, Cb − 128, Cr − 128) each.
PairColour level_of_light(const PairColour& light);
PairColour light_of_level(const PairColour& level);

}  // namespace goalmouth
