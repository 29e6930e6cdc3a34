#pragma once

#include "core/parameters/parameters.h"

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

}  // namespace goalmouth
