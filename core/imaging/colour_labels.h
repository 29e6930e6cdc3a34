#pragma once

#include "core/imaging/colour_regions.h"
#include "core/imaging/colour_table.h"
#include "core/imaging/yuyv.h"

#include <optional>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

// Training labels for a set of pictures of one pitch in which a person marked nothing but the goalposts.
namespace goalmouth {

/// The straight outline of a goalpost in an image [px]: its two side edges from the ground to the top.
struct PostOutline {
    cv::Point2d base_left, base_right, top_right, top_left;
    double width() const;
};

/// Base left, base right, top right, top left, to whole pixels: for cv::fillConvexPoly().
std::vector<cv::Point> corners(const PostOutline& post);

/// A picture with all its posts marked; in `ignore` nothing is known.
struct LabelledScene {
    YuyvImage image;
    std::vector<PostOutline> posts;
    std::vector<cv::Rect> ignore;
};

/// The carpet's colour: the mode of green (hue 180…290°) among pixels under the posts' bases, or in the lower
/// half where no post is in the picture, and all chroma around it that is at least 2 % as frequent, up to
/// where another surface's begins (ChromaHistogram::without_rivals). Throws std::invalid_argument where there
/// is no green at all.
ChromaRegion find_field_colour(std::span<const LabelledScene> scenes);

/// The posts' colour: the mode of the pixels inside their outlines and the chroma around it, in all the light
/// they stand in (ChromaHistogram::shades_of_mode). Throws std::invalid_argument without a post.
ChromaRegion find_goal_colour(std::span<const LabelledScene> scenes);

/// The pixels inside the outlines, a sixth of the width (and 1.5 px) away from each edge.
std::vector<Ycbcr> pixels_in_posts(YuyvView image, std::span<const PostOutline> posts);

/// What is known of a pitch's colours when its pictures are labelled.
struct SceneColours {
    ChromaRegion field;
    ChromaRegion goal;
    /// Without one: lines are pale (less than half the field's chroma) and brighter than the field around by
    /// 25 levels. With it: brighter_than_field() and of this chroma.
    std::optional<ChromaRegion> line;
    /// Without one: balls are orange, between red and the goal's hue.
    std::optional<ChromaRegion> ball;
    double darkest_goal = 0.0;  // luma below which nothing looks like a goal
};

/// Labels of one scene, CV_8UC1: class numbers, or ColourTrainer::no_label. Goal: inside the outlines, a
/// sixth of the width (and 1.5 px) away from each edge. Field: field-coloured below the upper rim of the
/// large field-coloured area. Line: there, in the line's colour. Ball: there, blobs of the ball's colour.
/// Unclassified: everything above that rim but posts and what is joined to them in their colour (crossbar,
/// stanchions). The rest, and pixels at borders between these, teach nothing.
cv::Mat label_scene(const LabelledScene& scene, const SceneColours& colours);
cv::Mat label_scene(const LabelledScene& scene, const ChromaRegion& field, const ChromaRegion& goal);

/// How a table does on one scene.
struct GoalColourScore {
    std::int64_t inside = 0;       // pixels inside the (eroded) outlines
    std::int64_t inside_goal = 0;  // of these, classified as goal
    std::int64_t elsewhere = 0;    // pixels away from any post; the band of the crossbar counts as neither
    std::int64_t elsewhere_goal = 0;
    GoalColourScore& operator+=(const GoalColourScore& other);
};
GoalColourScore score_goal_colour(const LabelledScene& scene, const ColourTable& table);
GoalColourScore score_goal_colour(YuyvView image, std::span<const PostOutline> posts,
                                  std::span<const cv::Rect> ignore, const ColourTable& table);

}  // namespace goalmouth
