#pragma once

#include "core/extraction/border.h"
#include "core/extraction/candidate_parameters.h"
#include "core/extraction/candidates.h"
#include "core/extraction/regions.h"
#include "core/extraction/runs.h"
#include "core/segmentation/segments.h"

#include <cstdint>
#include <vector>

namespace goalmouth {

/// Candidates for goalposts (paper, section 2, step 4: segments are judged by position, colour and length;
/// the text leaves open how, so this is ours).
///
///   colour    Colour::goal; short interruptions along the line (noise, highlights) are bridged.
///   length    shortest … longest.
///   region    Horizontal segments that overlap from row to row form regions; what shows on a few rows only
///             is noise. A vertical segment is kept with the regions it crosses.
///   position  A post stands on the field, so its region reaches down to the border or below, while yellow
///             things behind the field do not. Without a border in view positions are not judged.
///
/// Edge points come from the horizontal scan-lines alone: entering the post's colour is a left edge, leaving
/// it a right edge, whatever lies beside it (posts stand before walls too, not only before green as in the
/// paper's wording). On vertical scan-lines the same transition is a left or a right edge depending on the
/// post's lean, and most are the crossbar's. At the image border there is no transition and so no edge point.
/// Sub-pixel positions are the segments' transitions.
class CandidateExtractor {
  public:
    explicit CandidateExtractor(const CandidateParameters& parameters) : parameters_(parameters) {}

    /// Valid until the next call. No heap allocation once warm.
    const Candidates& extract(const Segments& segments, const FieldBorder& border);

  private:
    void find_runs(const Segments& segments);
    void add_field(const Segments& segments, const ScanLine& line);
    bool crosses_any(const Run& vertical) const;

    CandidateParameters parameters_;
    std::vector<std::uint32_t> order_;
    std::vector<Run> horizontal_;
    std::vector<Run> vertical_;
    RunRegions regions_;
    Candidates candidates_;
};

/// The candidates of one frame: a CandidateExtractor used once.
Candidates extract_candidates(const Segments& segments, const FieldBorder& border,
                              const CandidateParameters& parameters);

}  // namespace goalmouth
