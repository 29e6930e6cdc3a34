#include "tools/evaluate/paper_rule.h"

#include "core/evaluation/post_matching.h"

#include <nlohmann/json.hpp>

namespace goalmouth {

nlohmann::ordered_json paper_rule() {
    const MatchingRule rule;
    nlohmann::ordered_json j;
    j["fraction"] = rule.fraction;
    j["coverage"] = rule.coverage;
    j["posts"] =
        "true posts that count: in at least least_inside of its rows between the picture's top and bottom "
        "both edges lie between its left and right border, and no more than largest_hidden of what lies "
        "inside the picture is hidden; both numbers are settings of the scene";
    j["detected"] =
        "posts that a detection finds by the rule: at a quarter and at three quarters down the visible "
        "length, both edges lie within `fraction` of the true width of the true edges, measured along the "
        "row; the detection covers at least `coverage` of the visible length's rows; one detection for one "
        "post, the best agreeing first";
    j["identified"] =
        "posts that a detection means: the one that finds it, else the nearest one whose middle lies inside "
        "the post's outline or whose outline holds the post's middle, one-to-one";
    j["false_posts"] =
        "detections that find no post, except those that mean a post that does not count; one that means a "
        "post but fails the rule is false, and its post is missed";
    j["in_line_posts"] = "frames in which the post the camera stands in line with counts";
    j["in_line_detected"] = "of those, frames in which it is detected";
    j["in_line_identified"] = "of those, frames in which it is identified";
    j["measured"] =
        "of those, frames in which the detection gives a distance: what stands behind rmse_cm, bias_cm, "
        "sigma_cm, median_abs_cm, p95_abs_cm. Identified posts are taken, not only detected ones, because "
        "the rule cuts errors of width off";
    j["bias_cm"] =
        "mean of estimate minus truth; the truth is the distance along the ground from the camera "
        "to the post's axis";
    j["p95_abs_cm"] =
        "95th percentile of the absolute errors: of n errors in order that at place 0.95 (n - 1), counted "
        "from 0, linear between places";
    j["edge_offset_px"] =
        "mean distance along the row from the true left and right edge to the detected one, positive to the "
        "right, over in_line_detected";
    j["bearing_rmse_rad"] =
        "of the detection's bearing against that of the true post's middle line in the same row, over "
        "in_line_detected";
    j["second_post"] =
        "the same for the other post of the goal, which is off the camera's axis, where distance by width "
        "reads short by about the square of the cosine of the angle";
    j["good"] =
        "of a chain that refines: in_line_identified frames whose detection is flagged as measured anew in "
        "the pixels. rmse_cm, bias_cm, sigma_cm, median_abs_cm and p95_abs_cm of such a chain are over "
        "those, "
        "all_measured over every frame it measured; a chain refines if its graph has the program "
        "`refinement`, or if it calls any post good";
    j["both_edges"] =
        "frames in which the post in line counts and a third or more of each of its edges, of what lies "
        "between the picture's first and last row, is in the picture, not hidden, and differs from the "
        "background by three times the noise of a pair of pixels or more, in the complement of the post's "
        "colour; called good: of these, the frames that are good";
    j["bound_cm"] =
        "least standard deviation of the distance that the post's two edges allow anyone who is unbiased and "
        "knows the vertical (Cramér and Rao; core/refinement/bound.h): from the scene's noise and blur, the "
        "colours beside the true edges in the same frame drawn without noise, and the length of each edge "
        "that is seen. Root of the mean square over the measured frames; other cues, such as both posts of a "
        "goal, can do better";
    j["rmse_to_bound"] = "rmse_cm over bound_cm";
    j["bias_to_bar"] =
        "|bias_cm| over what rmse_cm may be: 1.3 times bound_cm, nearer than 3 m at least 0.15 % of the "
        "distance";
    j["median_to_bound"] = "median_abs_cm over 0.6745 times the median of the frames' bounds";
    j["normalised_error"] =
        "mean over good frames of e' S^-1 e / 2, e the errors of distance and bearing, S the covariance that "
        "the detection states: 1 where that is right, more where it claims too much; a covariance that is "
        "none counts as 1e6";
    return j;
}

}  // namespace goalmouth
