#pragma once

#include "core/extraction/border.h"
#include "core/extraction/candidates.h"
#include "core/extraction/regions.h"
#include "core/extraction/runs.h"
#include "core/parameters/parameters.h"
#include "core/segmentation/segments.h"

#include <cstdint>
#include <vector>

namespace goalmouth {

struct CandidateParameters {
    int largest_gap = 2;
    double gap_share = 0.25;
    int shortest = 2;
    double longest = 1.0;
    bool must_reach_border = true;
    double border_tolerance = 0.05;
    int region_gap = 3;
    int least_rows = 6;
};

template <class Visitor>
void describe_parameters(Visitor& v, CandidateParameters& p) {
    v("largest_gap", p.largest_gap, Range{0, 1024}, "px",
      "segments of the post's colour with no more than this between them on a scan-line are one");
    v("gap_share", p.gap_share, Range{0, 10}, "1",
      "and also where the gap is no longer than this share of the two together (shading and highlights of a "
      "near post)");
    v("shortest", p.shortest, Range{1, 16384}, "px", "shorter segments are rejected as noise");
    v("longest", p.longest, Range{0, 1}, "1",
      "segments longer than this share of the scan-line are rejected; 1: none");
    v("must_reach_border", p.must_reach_border,
      "reject what does not stand on the field: regions that end above its border");
    v("border_tolerance", p.border_tolerance, Range{0, 1}, "1",
      "how far above the border a region may end, as a share of the image height");
    v("region_gap", p.region_gap, Range{1, 1024}, "1",
      "segments one above the other and at most this many horizontal scan-lines apart belong to one region");
    v("least_rows", p.least_rows, Range{1, 16384}, "1",
      "regions seen on fewer horizontal scan-lines are rejected as noise (the paper's RANSAC needs 6 points "
      "for a line)");
}

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
