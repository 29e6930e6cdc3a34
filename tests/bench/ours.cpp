#include "tests/bench/ours.h"

#include "core/detection/ransac_detector.h"
#include "core/edges/edge_segmentation.h"
#include "core/extraction/border.h"
#include "core/extraction/extraction.h"
#include "core/random/random.h"
#include "core/segmentation/scan_lines.h"
#include "core/segmentation/segmentation.h"
#include "tests/reference/naive_segmentation.h"

#include <fmt/format.h>
#include <memory>

namespace goalmouth::bench {
namespace {

ScanLayout layout_of(const FrameSet& frames, int spacing) {
    ScanLineParameters parameters;
    parameters.row_spacing = spacing;
    parameters.column_spacing = spacing;
    return image_layout(frames.width(), frames.height(), parameters);
}

std::string named(const char* name, int spacing) {
    return fmt::format("{}_{}", name, spacing);
}

std::string settings_words(const ColourTable& table, int spacing) {
    return fmt::format("rows and columns every {} px; colour table {}, {} bits an axis", spacing,
                       table.name(), table.bits());
}

struct SegmentsOnly {
    const FrameSet& frames;
    ScanLayout layout;
    Segmenter segmenter;
    const Segments* last = nullptr;
};

struct EdgeSegments {
    const FrameSet& frames;
    ScanLayout layout;
    EdgeSegmenter segmenter;
    const Segments* last = nullptr;
};

struct NaiveSegments {
    const FrameSet& frames;
    const ColourTable& table;
    ScanLayout layout;
    Segments last;
};

struct Chain {
    const FrameSet& frames;
    std::uint64_t seed;
    ScanLayout layout;
    Segmenter segmenter;
    BorderFinder border;
    CandidateExtractor extractor;
    RansacDetector detector;
    const std::vector<Post>* last = nullptr;
};

Finding found_posts(const std::vector<Post>& posts) {
    Finding finding;
    finding.count = static_cast<double>(posts.size());
    for (const Post& post : posts) {
        finding.edges.push_back({post.left_top, post.left_base});
        finding.edges.push_back({post.right_top, post.right_base});
    }
    return finding;
}

}  // namespace

Contender our_segments(const FrameSet& frames, const ColourTable& table, int spacing) {
    const auto state =
        std::make_shared<SegmentsOnly>(SegmentsOnly{frames, layout_of(frames, spacing), Segmenter(table)});
    Contender contender;
    contender.name = named("segments", spacing);
    contender.label = "scan + segments";
    contender.settings = settings_words(table, spacing);
    contender.finds = "segments";
    contender.run = [state](std::size_t item, std::vector<double>&) {
        state->last = &state->segmenter.segment(state->frames.view(item), state->layout);
    };
    contender.finding = [state] { return Finding{static_cast<double>(state->last->segments.size()), {}}; };
    return contender;
}

Contender edge_segments(const FrameSet& frames, int spacing) {
    const auto state = std::make_shared<EdgeSegments>(
        EdgeSegments{frames, layout_of(frames, spacing), EdgeSegmenter(EdgeSegmentationParameters{})});
    Contender contender;
    contender.name = named("edge_segments", spacing);
    contender.label = "segments by edges";
    contender.settings = fmt::format(
        "rows and columns every {} px; the parameters of config/modules, no colour table", spacing);
    contender.finds = "posts";
    contender.run = [state](std::size_t item, std::vector<double>&) {
        state->last = &state->segmenter.segment(state->frames.view(item), state->layout);
    };
    contender.finding = [state] {
        Finding finding;
        for (const JudgedStrip& judged : state->segmenter.strips()) {
            if (!judged.refused.empty()) continue;
            const UprightStrip& s = judged.strip;
            finding.count += 1.0;
            for (const UprightLine& edge : {s.left, s.right})
                finding.edges.push_back({{edge.at(s.top()), s.top()}, {edge.at(s.base()), s.base()}});
        }
        return finding;
    };
    return contender;
}

Contender our_chain(const FrameSet& frames, const ColourTable& table, int spacing, std::uint64_t seed) {
    const auto state = std::make_shared<Chain>(
        Chain{frames, seed, layout_of(frames, spacing), Segmenter(table), BorderFinder(BorderParameters{}),
              CandidateExtractor(CandidateParameters{}),
              RansacDetector(RansacDetectorParameters{}, frames.field.post_diameter)});
    Contender contender;
    contender.name = named("frame_to_posts", spacing);
    contender.label = "frame → posts";
    contender.settings = settings_words(table, spacing) +
                         "; field border, candidates and RANSAC with the parameters of config/modules";
    contender.finds = "posts";
    contender.parts = {named("border", spacing), named("candidates", spacing), named("ransac", spacing)};
    contender.part_labels = {"field border", "candidates", "RANSAC and posts"};
    contender.run = [state](std::size_t item, std::vector<double>& part_ms) {
        const Segments& segments = state->segmenter.segment(state->frames.view(item), state->layout);
        Stopwatch watch;
        const FieldBorder& border = state->border.find(segments);
        const double border_ms = watch.lap();
        const Candidates& candidates = state->extractor.extract(segments, border);
        const double candidates_ms = watch.lap();
        Random random = random_for_frame(state->seed, "detection", static_cast<std::int64_t>(item));
        state->last = &state->detector.detect(candidates, state->frames.camera, random);
        part_ms.insert(part_ms.end(), {border_ms, candidates_ms, watch.lap()});
    };
    contender.finding = [state] { return found_posts(*state->last); };
    return contender;
}

Contender naive_segments(const FrameSet& frames, const ColourTable& table, int spacing) {
    const auto state =
        std::make_shared<NaiveSegments>(NaiveSegments{frames, table, layout_of(frames, spacing), {}});
    Contender contender;
    contender.name = named("naive_segments", spacing);
    contender.label = "naive scan-lines";
    contender.settings = settings_words(table, spacing) +
                         "; each row walked across, each column down, the table asked for every pixel: the "
                         "same segments bit by bit";
    contender.finds = "segments";
    contender.run = [state](std::size_t item, std::vector<double>&) {
        segment_frame_naively(state->frames.view(item), state->table, state->layout, state->last);
    };
    contender.finding = [state] { return Finding{static_cast<double>(state->last.segments.size()), {}}; };
    return contender;
}

}  // namespace goalmouth::bench
