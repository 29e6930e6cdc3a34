#pragma once

#include "core/parameters/parameters.h"

#include <string>

namespace goalmouth {

struct RefinementParameters {
    double least_quality = 0.5;
    int most_rows = 200;
    double start_tolerance = 0.2;
    double start_floor = 0.0075;
    double least_width = 2.5;
    double least_contrast = 3.0;
    std::string response = "auto";
    std::string chroma_shift = "auto";
    double black_level = 0.0;
    double level_sigma = 0.26;
    double tilt_floor = 0.002;
    double outline_floor = 0.002;
    double focal_error = 0.0;
    double diameter_error = 0.0;
    bool base_cue = true;
    bool height_cue = true;
    bool goal_cue = true;
    double goal_error = 0.005;
    double end_floor = 0.05;
    double cue_gate = 4.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, RefinementParameters& p) {
    v("least_quality", p.least_quality, Range{0, 1}, "1",
      "a post of which the pixels fit worse is handed on as the detector measured it");
    v("most_rows", p.most_rows, Range{16, 2000}, "1",
      "rows in which a post's edges are measured, at most: of more, neighbours are averaged");
    v("start_tolerance", p.start_tolerance, Range{0, 0.5}, "1",
      "how far beside the detector's edges the post's may lie, as a share of its width, or start_floor");
    v("start_floor", p.start_floor, Range{0, 0.1}, "1",
      "the same for narrow posts, as a share of the picture's width");
    v("least_width", p.least_width, Range{1, 100}, "px", "narrower posts are left alone");
    v("least_contrast", p.least_contrast, Range{0, 100}, "1",
      "an edge is looked for where the background differs from the post by this many sigmas of a pixel's "
      "noise, shading left out");
    v("response", p.response, Choice{"auto", "linear", "srgb"},
      "what the camera makes of light: levels in proportion to it, levels as screens expect them (most "
      "cameras), or "
      "as the colours between each picture's posts and background show beyond doubt, else linear");
    v("chroma_shift", p.chroma_shift, Choice{"auto", "none"},
      "chroma that lies beside the luma is moved onto it where each picture's posts show it beyond doubt, "
      "or never");
    v("black_level", p.black_level, Range{0, 64}, "1",
      "luma of black: 0 in full range, 16 in limited range video; matters for posts too evenly lit to show "
      "it");
    v("level_sigma", p.level_sigma, Range{0.001, 1.5}, "rad",
      "sigma of the camera's roll and pitch against level where its pose is not known");
    v("tilt_floor", p.tilt_floor, Range{0, 0.5}, "rad",
      "sigma of a post's lean against the vertical, beside that of the measured vertical");
    v("outline_floor", p.outline_floor, Range{0, 2}, "px",
      "sigma of an edge's place that does not shrink with more rows (lens, edge model)");
    v("focal_error", p.focal_error, Range{0, 0.2}, "1",
      "sigma of the focal length's relative error: adds as much to the distance's; no picture tells it");
    v("diameter_error", p.diameter_error, Range{0, 0.5}, "1",
      "sigma of the post diameter's relative error: adds as much to the distance's; no picture tells it");
    v("base_cue", p.base_cue,
      "where a post stands on the ground tells its distance too, if the camera's pose is known");
    v("height_cue", p.height_cue, "how high a post is tells its distance too");
    v("goal_cue", p.goal_cue, "two posts of one goal tell the distance of both");
    v("goal_error", p.goal_error, Range{0, 1}, "m", "sigma of a goal's height and width as it stands there");
    v("end_floor", p.end_floor, Range{0, 5}, "px",
      "sigma of a post's base and top that does not shrink with more pixels (pile of a carpet, edge model)");
    v("cue_gate", p.cue_gate, Range{1, 100}, "1",
      "sigmas by which another cue may be off the width's distance to count");
}

}  // namespace goalmouth
