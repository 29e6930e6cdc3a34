#pragma once

#include "core/imaging/colour.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace goalmouth {

/// Colour look-up table (paper, section 2): YCbCr → class, 2ⁿ entries an axis, n = 5…8. Entries lie as
/// [Cb][Cr][Y], so that the two pixels of a 4:2:2 pair, which share their chroma, fall into one short run of
/// the table.
class ColourTable {
  public:
    /// All entries unclassified. Throws std::invalid_argument where bits is outside 5…8.
    explicit ColourTable(int bits = 6, std::string name = "");

    int bits() const { return bits_; }
    const std::string& name() const { return name_; }
    void set_name(std::string name) { name_ = std::move(name); }
    /// How it was made, for people: one line for each step.
    const std::vector<std::string>& provenance() const { return provenance_; }
    void add_provenance(std::string line) { provenance_.push_back(std::move(line)); }

    std::size_t index(Ycbcr p) const {
        const int shift = 8 - bits_;
        return (static_cast<std::size_t>(p.cb >> shift) << (2 * bits_)) |
               (static_cast<std::size_t>(p.cr >> shift) << bits_) | static_cast<std::size_t>(p.y >> shift);
    }
    Colour at(Ycbcr p) const { return static_cast<Colour>(entries_[index(p)]); }
    void set(Ycbcr p, Colour colour) { entries_[index(p)] = static_cast<std::uint8_t>(colour); }

    /// 2³ⁿ class numbers.
    const std::vector<std::uint8_t>& entries() const { return entries_; }
    std::vector<std::uint8_t>& entries() { return entries_; }

    bool operator==(const ColourTable& other) const {
        return bits_ == other.bits_ && entries_ == other.entries_;
    }

  private:
    int bits_;
    std::string name_;
    std::vector<std::string> provenance_;
    std::vector<std::uint8_t> entries_;
};

/// The colour in the middle of the cell a table of `bits` an axis has for `p`.
Ycbcr cell_centre(Ycbcr p, int bits);

/// The same classes in a table of another fineness. Finer repeats the entries; coarser takes, of the entries
/// a new cell covers, the most frequent class, the one of the lower number where two are level (so
/// unclassified before any other).
ColourTable resampled(const ColourTable& table, int bits);

/// How many of its entries each class has.
std::array<std::size_t, colour_count> class_counts(const ColourTable& table);

}  // namespace goalmouth
