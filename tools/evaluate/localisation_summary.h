#pragma once

#include "tools/evaluate/localisation_data.h"

#include <array>
#include <string>
#include <vector>

namespace goalmouth {

/// Over runs.
struct MeanSigma {
    double mean = 0.0;
    double sigma = 0.0;  // over n − 1
};

/// Over all runs: error and the filter's own uncertainty.
struct QualitySummary {
    MeanSigma position_error;      // m
    MeanSigma heading_error;       // rad
    MeanSigma position_sigma;      // m
    MeanSigma heading_sigma;       // rad
    double position_median = 0.0;  // m, of the runs' errors
    double heading_median = 0.0;   // rad
};

struct DetectorSummary {
    std::string detector;
    int runs = 0;
    QualitySummary walk;
    QualitySummary end;
    double lost = 0.0;             // share of runs whose end is further off than lost_beyond
    double posts_per_frame = 0.0;  // found
};
std::vector<DetectorSummary> summarise(const LocalisationResult& result);

/// 1 − mean of one detector / mean of another over the same runs, with the 95 % interval of a bootstrap that
/// draws runs, both detectors' together.
struct Reduction {
    double value = 0.0;
    double low = 0.0;
    double high = 0.0;
};

/// One detector against the baseline: the walk's and the end's errors, and what the filter believes.
struct DetectorComparison {
    std::string detector;
    std::string against;
    Reduction walk_position_error, walk_heading_error, end_position_error, end_heading_error;
    Reduction walk_position_sigma, walk_heading_sigma, end_position_sigma, end_heading_sigma;
};

/// Every other detector against "histogram", or the first where there is none of that name. Draws follow from
/// the result's seed. Nothing with less than two runs.
std::vector<DetectorComparison> compare(const LocalisationResult& result);

/// What the paper reports (its section on self-localisation).
struct PaperLocalisation {
    MeanSigma histogram_position{0.313, 0.055};  // m
    MeanSigma ransac_position{0.2557, 0.051};
    MeanSigma histogram_heading{0.14, 0.06};  // rad
    MeanSigma ransac_heading{0.10, 0.05};
    double position_reduction = 0.18;
    double heading_reduction = 0.29;         // as its numbers say
    double heading_reduction_stated = 0.34;  // as its text says
};

}  // namespace goalmouth
