#pragma once

#include "core/colour_learning/salient_colour.h"
#include "core/imaging/colour.h"
#include "core/imaging/colour_labels.h"
#include "core/imaging/colour_table.h"
#include "core/imaging/colour_training.h"
#include "core/imaging/yuyv.h"

#include <array>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace goalmouth {

/// Why no table can be learnt from pictures, for people: a sentence.
class NothingToLearn : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What a class was learnt from, and how far to trust it.
struct LearntClass {
    int pictures = 0;      // in which it was seen
    double samples = 0.0;  // pixels
    Ycbcr mean;            // of the samples
    /// Two tables are learnt from every other picture each and tried on the rest: share of the pixels taken
    /// for this class there that such a table calls so, and of those it calls so that were taken for it.
    /// Nothing where one half had none.
    std::optional<double> recall, precision;
    /// Harmonic mean of the two, 0 without them: how well pictures agree about the class.
    double confidence() const;
};

struct LearntPicture {
    LabelledScene scene;  // shrunk; with the posts that were found
    cv::Mat labels;       // CV_8UC1, as label_scene(): of the shrunk scene; a Lesson with the picture itself
};

struct LearntColours {
    ColourTable table;
    std::array<LearntClass, colour_count> classes;
    SalientGoal goal;  // as first found
    std::vector<LearntPicture> pictures;
};

/// Learns a table from pictures of one pitch without labels (the idea of Budden and Mendes 2013: colours are
/// known by where what has them stands; the way is ours):
///
///   1. Pictures are shrunk to 640 px or less.
///   2. The field's colour, then the lines' (field_colours.h), then the goal's (salient_colour.h).
///   3. The posts found so are outlines such as a person would have drawn: label_scene() labels the pictures
///      and ColourTrainer makes a table. Goal-coloured things that stand on the field or leave the picture
///      but were not recognised as posts teach nothing.
///   4. That table finds more posts, of which those with the same colour inside take the place of the first;
///      once more from 3.
///
/// A ball's colour about which the pictures do not agree (confidence below ½) is left out.
///
/// With white goals the lines' colour is the goal's class wherever they cannot be told apart.
///
/// The result depends on the pictures and their order alone. Throws NothingToLearn where there is no picture,
/// no field or no goalpost in them.
LearntColours learn_without_labels(std::span<const YuyvImage> pictures, GoalPaint paint, int bits,
                                   const std::string& name);

}  // namespace goalmouth
