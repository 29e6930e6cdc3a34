#pragma once

#include "core/parameters/parameters.h"

namespace goalmouth {

struct EdgeParameters {
    double window = 4.0;
    double chroma_weight = 2.0;
    double noise_factor = 4.0;
    double least_strength = 4.0;
    double most_noise = 3.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, EdgeParameters& p) {
    v("window", p.window, Range{2, 32}, "px",
      "pixels averaged on either side of an edge, for a picture 640 px wide; grows with its width");
    v("chroma_weight", p.chroma_weight, Range{0, 16}, "1",
      "weight of the squared steps of the colour differences beside luma's; 0: edges of brightness alone");
    v("noise_factor", p.noise_factor, at_least(0), "1",
      "an edge is stronger than this many times the frame's median step (noise and the grass's texture)");
    v("least_strength", p.least_strength, above(0), "grey levels", "and no weaker than this");
    v("most_noise", p.most_noise, at_least(0), "grey levels",
      "a picture whose median step is larger is blurred along its columns first, once or twice");
}

struct FieldPriorParameters {
    double least_share = 0.1;
};

template <class Visitor>
void describe_parameters(Visitor& v, FieldPriorParameters& p) {
    v("least_share", p.least_share, Range{0, 1}, "1",
      "share of the picture, its lower part counting more, that the field's colour takes at least; less is "
      "no "
      "field, and without one no post");
}

struct StripParameters {
    int least_rows = 8;
    int largest_gap = 2;
    double largest_lean = 0.6;
    double straightness = 2.0;
    double sameness = 0.5;
    double narrowest = 6.0;
    double widest = 0.35;
    double largest_taper = 0.35;
    double least_aspect = 1.5;
    double least_whole_aspect = 5.5;
    double largest_aspect = 20.0;
    double least_brightness = 1.0;
    double foot_tolerance = 0.02;
    double least_rise = 0.2;
    double width_ratio = 2.0;
    double lowest = 0.5;
    double highest = 2.2;
};

template <class Visitor>
void describe_parameters(Visitor& v, StripParameters& p) {
    v("least_rows", p.least_rows, Range{3, 16384}, "1",
      "horizontal scan-lines on which both edges of a post are seen");
    v("largest_gap", p.largest_gap, Range{0, 1024}, "1",
      "horizontal scan-lines one after the other on which an edge, or the surface between, may be missing");
    v("largest_lean", p.largest_lean, Range{0, 1.5}, "rad", "how far an edge may lean from the vertical");
    v("straightness", p.straightness, above(0), "px",
      "how far an edge may lie from its straight line, for a picture 640 px wide; grows with its width");
    v("sameness", p.sameness, above(0), "1",
      "how unlike a post's surface may look from row to row and from edge to edge, as a share of how unlike "
      "its surroundings look");
    v("narrowest", p.narrowest, at_least(0), "px",
      "what is narrower is no post, for a picture 640 px wide; grows with its width (a post 6 m off: 9 px)");
    v("widest", p.widest, Range{0, 1}, "1", "what is wider is no post, as a share of the picture's width");
    v("largest_taper", p.largest_taper, at_least(0), "1",
      "how much the width may change from end to end, as a share of it");
    v("least_aspect", p.least_aspect, at_least(0), "1", "least length of a post over its width");
    v("least_whole_aspect", p.least_whole_aspect, at_least(0), "1",
      "the same for one that ends below the picture's top: no goal is lower (KidSize 2013: 8)");
    v("largest_aspect", p.largest_aspect, at_least(0), "1", "no goal is higher (KidSize since 2020: 18)");
    v("least_brightness", p.least_brightness, at_least(0), "1",
      "luma of a post over the field's: posts are yellow or white; 0: any");
    v("foot_tolerance", p.foot_tolerance, Range{0, 1}, "1",
      "how far above the field's border a post may end, as a share of the picture's height");
    v("least_rise", p.least_rise, Range{0, 1}, "1",
      "share of a post's length that stands above the field's border: lines on the field lie below it");
    v("width_ratio", p.width_ratio, Range{1, 1000}, "1",
      "with kinematics: how many times wider or narrower than a post at its foot's distance it may look");
    v("lowest", p.lowest, at_least(0), "m",
      "with kinematics: least height of a post whose top is in the picture");
    v("highest", p.highest, at_least(0), "m", "with kinematics: largest height");
}

struct EdgeSegmentationParameters {
    EdgeParameters edges;
    FieldPriorParameters field;
    StripParameters posts;
};

template <class Visitor>
void describe_parameters(Visitor& v, EdgeSegmentationParameters& p) {
    v.group("edges", p.edges, "what is an edge along a scan-line");
    v.group("field_prior", p.field, "the field's colour, found in each frame");
    v.group("posts", p.posts, "which pairs of edges are a post's");
}

}  // namespace goalmouth
