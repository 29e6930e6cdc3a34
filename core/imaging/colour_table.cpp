#include "core/imaging/colour_table.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace goalmouth {

ColourTable::ColourTable(int bits, std::string name) : bits_(bits), name_(std::move(name)) {
    if (bits < 5 || bits > 8)
        throw std::invalid_argument("a colour table has 5 to 8 bits an axis, not " + std::to_string(bits));
    entries_.assign(std::size_t{1} << (3 * bits), 0);
}

Ycbcr cell_centre(Ycbcr p, int bits) {
    const int shift = 8 - bits;
    const auto centre = [shift](std::uint8_t v) {
        return static_cast<std::uint8_t>(((v >> shift) << shift) + ((1 << shift) >> 1));
    };
    return {centre(p.y), centre(p.cb), centre(p.cr)};
}

namespace {

std::uint8_t majority(const ColourTable& table, std::size_t cb, std::size_t cr, std::size_t y,
                      int finer_bits) {
    const std::size_t side = std::size_t{1} << finer_bits;
    std::array<int, colour_count> votes{};
    for (std::size_t i = 0; i < side; ++i) {
        for (std::size_t j = 0; j < side; ++j) {
            const std::size_t start =
                ((cb * side + i) << (2 * table.bits())) | ((cr * side + j) << table.bits()) | (y * side);
            for (std::size_t k = 0; k < side; ++k)
                ++votes[std::min<std::size_t>(table.entries()[start + k], colour_count - 1)];
        }
    }
    return static_cast<std::uint8_t>(std::max_element(votes.begin(), votes.end()) - votes.begin());
}

}  // namespace

ColourTable resampled(const ColourTable& table, int bits) {
    ColourTable out(bits, table.name());
    for (const std::string& line : table.provenance()) out.add_provenance(line);
    if (bits != table.bits())
        out.add_provenance("resampled from " + std::to_string(table.bits()) + " to " + std::to_string(bits) +
                           " bits an axis");
    const std::size_t side = std::size_t{1} << bits;
    const int coarser = bits - table.bits();  // > 0: several new cells lie in one old one
    std::size_t entry = 0;
    for (std::size_t cb = 0; cb < side; ++cb) {
        for (std::size_t cr = 0; cr < side; ++cr) {
            for (std::size_t y = 0; y < side; ++y, ++entry) {
                if (coarser >= 0) {
                    const std::size_t from = ((cb >> coarser) << (2 * table.bits())) |
                                             ((cr >> coarser) << table.bits()) | (y >> coarser);
                    out.entries()[entry] = table.entries()[from];
                } else {
                    out.entries()[entry] = majority(table, cb, cr, y, -coarser);
                }
            }
        }
    }
    return out;
}

std::array<std::size_t, colour_count> class_counts(const ColourTable& table) {
    std::array<std::size_t, colour_count> counts{};
    for (const std::uint8_t entry : table.entries())
        if (entry < colour_count) ++counts[entry];
    return counts;
}

}  // namespace goalmouth
