#pragma once

#include "core/detection/post.h"

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace goalmouth::test {

/// A post somebody marked by hand [px]: its straight side edges.
struct AnnotatedPost {
    Eigen::Vector2d left_top, left_base, right_top, right_base;
    double width = 0.0;  // px at the base
};

/// One picture of annotations.json; without posts: a picture without a goalpost.
struct AnnotatedImage {
    std::string set;   // folder
    std::string file;  // within the data folder
    std::vector<AnnotatedPost> posts;
    std::vector<Eigen::AlignedBox2d> ignore;
};

/// Pictures with posts, then those without; the excluded ones are left out.
std::vector<AnnotatedImage> read_annotations(const std::filesystem::path& file);

/// How detections compare with annotations.
struct Score {
    int found = 0;
    int missed = 0;
    int wrong = 0;

    double recall() const { return found + missed > 0 ? static_cast<double>(found) / (found + missed) : 1.0; }
    double precision() const {
        return found + wrong > 0 ? static_cast<double>(found) / (found + wrong) : 1.0;
    }
    Score& operator+=(const Score& other);
};

/// A post is found when both side edges of a detection lie within max(3 px, 25 % of the post's width) of its
/// annotated lines, measured along the row at a quarter and three quarters of the annotated height. One
/// detection counts for one post. A detection centred in an ignore box is neither right nor wrong.
Score score(const AnnotatedImage& image, const std::vector<Post>& detections);

}  // namespace goalmouth::test
