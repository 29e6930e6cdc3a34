#pragma once

#include "core/detection/cut_posts.h"
#include "core/detection/measurement.h"
#include "core/detection/post_sides.h"
#include "core/parameters/parameters.h"

namespace goalmouth {

struct UprightSearchParameters {
    double tolerance = 2.0;
    double lean_sigma = 0.03;
    double level_sigma = 0.26;
    double nearest = 0.2;
    double farthest = 10.0;
    double least_edge = 0.1;
    double least_cover = 0.4;
    int least_rows = 6;
    double least_score = 0.3;
};

template <class Visitor>
void describe_parameters(Visitor& v, UprightSearchParameters& p) {
    v("tolerance", p.tolerance, Range{0.1, 100}, "px",
      "edge points nearer than this to an edge agree with it");
    v("lean_sigma", p.lean_sigma, Range{0, 0.5}, "rad",
      "sigma of a post's lean in the picture beside that of the measured vertical (posts, rolling shutter)");
    v("level_sigma", p.level_sigma, Range{0.001, 1.5}, "rad",
      "sigma of the camera's roll and pitch against level where its pose is not known");
    v("nearest", p.nearest, Range{0.05, 1000}, "m", "nearest plausible distance");
    v("farthest", p.farthest, Range{0.1, 1000}, "m", "farthest plausible distance");
    v("least_edge", p.least_edge, Range{0, 1}, "1",
      "share of a post's rows in the picture in which either edge has to be seen");
    v("least_cover", p.least_cover, Range{0, 1}, "1", "share of them that have to have the post's colour");
    v("least_rows", p.least_rows, Range{1, 16384}, "1", "scan-lines on which a post has to have its colour");
    v("least_score", p.least_score, Range{-3, 2}, "1",
      "mean evidence of a row (upright_evidence.h) from which on something is a post; 2: each shows both "
      "edges");
}

struct UprightDetectorParameters {
    UprightSearchParameters search;
    CutPostParameters cut_posts;
    MeasurementParameters measurement;
    PostSideParameters sides;
};

template <class Visitor>
void describe_parameters(Visitor& v, UprightDetectorParameters& p) {
    v.group("search", p.search, "what counts as a post");
    v.group("cut_posts", p.cut_posts, "posts that the image's border cuts");
    v.group("measurement", p.measurement, "distance, bearing and their uncertainty");
    v.group("sides", p.sides, "which post of its goal");
}

}  // namespace goalmouth
