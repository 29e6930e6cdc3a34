#include "core/extraction/runs.h"

namespace goalmouth {
namespace {

bool belong_together(const CandidateSegment& a, const Segment& b, const CandidateParameters& parameters) {
    const int gap = b.start - a.end - 1;
    return gap <= parameters.largest_gap || gap <= parameters.gap_share * (a.length() + b.length());
}

}  // namespace

void append_runs(const Segments& segments, const ScanLine& line, int row,
                 const CandidateParameters& parameters, std::vector<Run>& runs) {
    const int size = line.orientation == Orientation::horizontal ? segments.width : segments.height;
    const double longest = parameters.longest * size;
    const Segment* const begin = segments.segments.data() + line.first;
    const Segment* const end = begin + line.count;
    Run run;
    bool open = false;
    const auto close = [&] {
        const int length = run.segment.length();
        if (length >= parameters.shortest && length <= longest) runs.push_back(run);
    };
    for (const Segment* s = begin; s != end; ++s) {
        if (s->colour != Colour::goal) continue;
        if (!open || !belong_together(run.segment, *s, parameters)) {
            if (open) close();
            run = {{line.orientation, line.position, s->start, s->end}, {}, {}, row};
            if (s != begin) run.entry = s->transition;
            open = true;
        }
        run.segment.end = s->end;
        run.exit.reset();
        if (s + 1 != end) run.exit = s[1].transition;
    }
    if (open) close();
}

}  // namespace goalmouth
