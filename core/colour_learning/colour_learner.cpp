#include "core/colour_learning/colour_learner.h"

#include "core/colour_learning/field_colours.h"
#include "core/colour_learning/lesson.h"
#include "core/colour_learning/standing_posts.h"
#include "core/imaging/shrink.h"

#include <algorithm>
#include <string>

#include <opencv2/imgproc.hpp>

namespace goalmouth {

namespace {

constexpr int rounds = 2;                      // of labelling and finding posts anew
constexpr double same_inside = 0.7;            // share of a post's pixels in the goal's colour
constexpr double least_ball_confidence = 0.5;  // below, more of what is called ball is none than is
constexpr double darkest_share = 0.02;         // quantile of the posts' luma …
constexpr double darker_still = 0.8;           // … and how far below it the goal's shade may go

/// Luma that all but a few of the posts' pixels reach.
double darkest_of(std::span<const LabelledScene> scenes, const ChromaRegion& goal) {
    std::array<double, 256> counts{};
    double all = 0.0;
    for (const LabelledScene& scene : scenes) {
        for (const Ycbcr p : pixels_in_posts(scene.image.view(), scene.posts)) {
            if (!goal.holds(p)) continue;
            counts[p.y] += 1.0;
            all += 1.0;
        }
    }
    double below = 0.0;
    int luma = 0;
    while (luma < 255 && below + counts[static_cast<std::size_t>(luma)] < darkest_share * all)
        below += counts[static_cast<std::size_t>(luma++)];
    return darker_still * luma;
}

/// Whether a post has the goal's colour inside.
bool same_colour(YuyvView image, const PostOutline& post, const SceneColours& colours) {
    const std::vector<Ycbcr> pixels = pixels_in_posts(image, {&post, 1});
    const auto same =
        std::count_if(pixels.begin(), pixels.end(), [&](Ycbcr p) { return colours.goal.holds(p); });
    return !pixels.empty() && static_cast<double>(same) >= same_inside * static_cast<double>(pixels.size());
}

/// Boxes of what has the goal's colour and stands on the pitch or leaves the picture, higher than wide, but
/// was not taken for a post: it may be one.
std::vector<cv::Rect> doubtful(const LabelledScene& scene, const SceneColours& colours) {
    const YuyvView image = scene.image.view();
    const double scale = image_scale(image.width);
    const cv::Mat like_field = mask_of(image, [&](Ycbcr p) { return colours.field.holds(p); });
    cv::Mat like_goal = mask_of(image, [&](Ycbcr p) {
        return p.y >= colours.darkest_goal && colours.goal.holds(p) && !colours.field.holds(p);
    });
    cv::morphologyEx(like_goal, like_goal, cv::MORPH_CLOSE, disc(3.0 * scale));
    cv::Mat pitch = pitch_mask(like_field, scale);
    cv::dilate(pitch, pitch, disc(6.0 * scale), {-1, -1}, 1, cv::BORDER_REPLICATE);
    cv::Mat posts = cv::Mat::zeros(pitch.size(), CV_8UC1);
    for (const PostOutline& post : scene.posts) cv::fillConvexPoly(posts, corners(post), cv::Scalar(255));

    std::vector<cv::Rect> boxes;
    const Blobs blobs = blobs_of(like_goal);
    for (int i = 1; i < blobs.count; ++i) {
        const cv::Rect box = blobs.box(i);
        if (blobs.area(i) < 30.0 * scale * scale || box.height < 1.5 * box.width) continue;
        const cv::Mat own = blobs.labels(box) == i;
        if (cv::countNonZero(posts(box) & own) > 0) continue;
        const bool leaves = box.x == 0 || box.y == 0 || box.br().x == image.width;
        const bool stands = cv::countNonZero(pitch(box) & own) > 0;
        if (!leaves && !stands) continue;
        const int margin = static_cast<int>(3.0 * scale);
        boxes.emplace_back(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin);
    }
    return boxes;
}

void set_posts(std::vector<LabelledScene>& scenes, std::vector<std::vector<PostOutline>> posts) {
    for (std::size_t i = 0; i < scenes.size(); ++i) scenes[i].posts = std::move(posts[i]);
}

/// Which chroma is what, from the posts the scenes have now.
SceneColours colours_of(std::span<const LabelledScene> scenes, std::span<const YuyvImage> images,
                        const ChromaRegion& field, const std::optional<ChromaRegion>& line) {
    ChromaRegion none;
    none.cells = cv::Mat::zeros(64, 64, CV_8UC1);
    SceneColours colours;
    colours.field = field;
    colours.goal = find_goal_colour(scenes);
    colours.line = line.value_or(none);
    colours.ball = find_ball_colour(images, field, line, colours.goal).value_or(none);
    colours.darkest_goal = darkest_of(scenes, colours.goal);
    return colours;
}

/// RANSAC's outlines are less exact than a person's: what in them has another chroma than most is not the
/// post's.
void keep_goal_colour(cv::Mat& labels, YuyvView image, const ChromaRegion& goal) {
    for (int y = 0; y < labels.rows; ++y) {
        std::uint8_t* row = labels.ptr<std::uint8_t>(y);
        for (int x = 0; x < labels.cols; ++x)
            if (row[x] == static_cast<std::uint8_t>(Colour::goal) && !goal.holds(image.at(x, y)))
                row[x] = ColourTrainer::no_label;
    }
}

std::vector<cv::Mat> labels_of(std::vector<LabelledScene>& scenes, const SceneColours& colours) {
    std::vector<cv::Mat> labels;
    for (LabelledScene& scene : scenes) {
        scene.ignore = doubtful(scene, colours);
        labels.push_back(label_scene(scene, colours));
        keep_goal_colour(labels.back(), scene.image.view(), colours.goal);
    }
    return labels;
}

/// Takes a class out of what the pictures teach.
void forget(Colour colour, std::span<cv::Mat> labels) {
    for (cv::Mat& of_picture : labels)
        of_picture.setTo(ColourTrainer::no_label, of_picture == static_cast<int>(colour));
}

std::vector<Lesson> lessons_of(std::span<const YuyvImage> pictures, std::span<const cv::Mat> labels) {
    std::vector<Lesson> lessons;
    for (std::size_t i = 0; i < pictures.size(); ++i) lessons.push_back({pictures[i].view(), labels[i]});
    return lessons;
}

/// Trained on the pictures of one parity, or all of them.
ColourTrainer trained(std::span<const Lesson> lessons, std::optional<std::size_t> parity = std::nullopt) {
    ColourTrainer trainer;
    for (std::size_t i = 0; i < lessons.size(); ++i)
        if (!parity || i % 2 == *parity)
            lessons[i].each([&](Ycbcr p, std::uint8_t label) { trainer.add(p, static_cast<Colour>(label)); });
    return trainer;
}

std::array<LearntClass, colour_count> classes_of(std::span<const Lesson> lessons) {
    std::array<LearntClass, colour_count> classes;
    std::array<std::array<double, 3>, colour_count> sums{};
    for (const Lesson& lesson : lessons) {
        std::array<bool, colour_count> seen{};
        lesson.each([&](Ycbcr p, std::uint8_t label) {
            seen[label] = true;
            classes[label].samples += 1.0;
            sums[label][0] += p.y;
            sums[label][1] += p.cb;
            sums[label][2] += p.cr;
        });
        for (std::size_t c = 0; c < colour_count; ++c) classes[c].pictures += seen[c];
    }
    for (std::size_t c = 0; c < colour_count; ++c) {
        const double n = std::max(classes[c].samples, 1.0);
        classes[c].mean = {cv::saturate_cast<std::uint8_t>(sums[c][0] / n),
                           cv::saturate_cast<std::uint8_t>(sums[c][1] / n),
                           cv::saturate_cast<std::uint8_t>(sums[c][2] / n)};
    }
    return classes;
}

/// Trains on each half, tries on the other.
std::array<LearntClass, colour_count> checked_classes(std::span<const Lesson> lessons) {
    std::array<LearntClass, colour_count> classes = classes_of(lessons);
    std::array<double, colour_count> taken{}, called{}, both{};
    std::array<bool, colour_count> in_both_halves{};
    in_both_halves.fill(true);
    for (const std::size_t parity : {std::size_t{0}, std::size_t{1}}) {
        const ColourTrainer trainer = trained(lessons, parity);
        for (std::size_t c = 0; c < colour_count; ++c)
            in_both_halves[c] = in_both_halves[c] && trainer.samples()[c] > 0.0;
        if (!trainer.has_class()) return classes;
        const ColourTable table = trainer.table(6, "");
        for (std::size_t i = 1 - parity; i < lessons.size(); i += 2) {
            lessons[i].each([&](Ycbcr p, std::uint8_t label) {
                const auto answer = static_cast<std::size_t>(table.at(p));
                taken[label] += 1.0;
                called[answer] += 1.0;
                both[label] += answer == label;
            });
        }
    }
    for (std::size_t c = 0; c < colour_count; ++c) {
        if (!in_both_halves[c]) continue;
        classes[c].recall = both[c] / std::max(taken[c], 1.0);
        classes[c].precision = both[c] / std::max(called[c], 1.0);
    }
    return classes;
}

}  // namespace

double LearntClass::confidence() const {
    const double sum = recall.value_or(0.0) + precision.value_or(0.0);
    return sum > 0.0 ? 2.0 * recall.value_or(0.0) * precision.value_or(0.0) / sum : 0.0;
}

LearntColours learn_without_labels(std::span<const YuyvImage> pictures, GoalPaint paint, int bits,
                                   const std::string& name) {
    if (pictures.empty()) throw NothingToLearn("there is no picture to learn from");
    std::vector<YuyvImage> images;
    for (const YuyvImage& picture : pictures)
        images.push_back(shrunk(picture.view(), shrink_factor(picture.view(), widest_labelled)));
    const std::string of_these = "none of the " + std::to_string(images.size()) + " pictures shows ";

    const auto field = find_field_colour(images);
    if (!field)
        throw NothingToLearn(of_these +
                             "a field: a large green area in the lower half is what is looked for");
    const auto line = find_line_colour(images, *field);
    if (paint == GoalPaint::white && !line)
        throw NothingToLearn(of_these + "a line on the field, which is what tells how white looks there");
    const auto goal = find_goal(images, *field, line, paint);
    if (!goal) {
        throw NothingToLearn(
            of_these + "a goalpost: something " + (paint == GoalPaint::yellow ? "yellow" : "white") +
            ", upright and straight that stands on the field and rises above its border is what "
            "is looked for");
    }

    std::vector<LabelledScene> scenes;
    for (const YuyvImage& image : images) scenes.push_back({image, {}, {}});
    set_posts(scenes, goal->posts);
    SceneColours colours = colours_of(scenes, images, *field, line);
    std::vector<cv::Mat> labels = labels_of(scenes, colours);
    for (int round = 0; round < rounds; ++round) {
        auto posts = standing_posts(images, trained(lessons_of(pictures, labels)).table(6, name), true);
        for (std::size_t i = 0; i < posts.size(); ++i)
            std::erase_if(posts[i], [&](const PostOutline& post) {
                return !same_colour(images[i].view(), post, colours);
            });
        if (std::all_of(posts.begin(), posts.end(), [](const auto& p) { return p.empty(); })) break;
        set_posts(scenes, std::move(posts));
        colours = colours_of(scenes, images, *field, line);
        labels = labels_of(scenes, colours);
    }

    LearntColours learnt;
    // Labels are shared with the lessons, so what is forgotten is gone from both.
    const std::vector<Lesson> lessons = lessons_of(pictures, labels);
    learnt.classes = checked_classes(lessons);
    const LearntClass& ball = learnt.classes[static_cast<std::size_t>(Colour::ball)];
    if (ball.samples > 0 && ball.confidence() < least_ball_confidence) {
        forget(Colour::ball, labels);
        learnt.classes = checked_classes(lessons);
    }
    learnt.table = trained(lessons).table(bits, name);
    learnt.goal = *goal;
    for (std::size_t i = 0; i < scenes.size(); ++i)
        learnt.pictures.push_back({std::move(scenes[i]), std::move(labels[i])});
    return learnt;
}

}  // namespace goalmouth
