#include "tests/tools_detect/annotations.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace goalmouth::test {
namespace {

using Json = nlohmann::json;

Eigen::Vector2d point(const Json& j) {
    return {j.at(0).get<double>(), j.at(1).get<double>()};
}

double x_at(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double y) {
    if (a.y() == b.y()) return std::numeric_limits<double>::infinity();
    return a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y());
}

/// Largest distance of the edges at two heights, as a share of what is allowed.
double mismatch(const AnnotatedPost& truth, const Post& found) {
    const double allowed = std::max(3.0, 0.25 * truth.width);
    const double top = std::max(0.0, 0.5 * (truth.left_top.y() + truth.right_top.y()));
    const double base = 0.5 * (truth.left_base.y() + truth.right_base.y());
    double worst = 0.0;
    for (const double share : {0.25, 0.75}) {
        const double y = top + share * (base - top);
        const double left =
            x_at(found.left_top, found.left_base, y) - x_at(truth.left_top, truth.left_base, y);
        const double right =
            x_at(found.right_top, found.right_base, y) - x_at(truth.right_top, truth.right_base, y);
        worst = std::max({worst, std::abs(left), std::abs(right)});
    }
    return worst / allowed;
}

Eigen::Vector2d centre(const Post& p) {
    return 0.25 * (p.left_top + p.left_base + p.right_top + p.right_base);
}

}  // namespace

Score& Score::operator+=(const Score& other) {
    found += other.found;
    missed += other.missed;
    wrong += other.wrong;
    return *this;
}

std::vector<AnnotatedImage> read_annotations(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error("cannot read " + file.string());
    const Json all = Json::parse(in);
    std::vector<AnnotatedImage> images;
    for (const char* list : {"images", "negatives"}) {
        for (const Json& entry : all.at(list)) {
            AnnotatedImage image;
            image.set = entry.at("set");
            image.file = entry.at("file");
            for (const Json& p : entry.value("posts", Json::array())) {
                image.posts.push_back({point(p.at("top_left")), point(p.at("base_left")),
                                       point(p.at("top_right")), point(p.at("base_right")),
                                       p.at("width_base_px").get<double>()});
            }
            for (const Json& box : entry.value("ignore", Json::array())) {
                image.ignore.emplace_back(Eigen::Vector2d(box.at(0), box.at(1)),
                                          Eigen::Vector2d(box.at(2), box.at(3)));
            }
            images.push_back(std::move(image));
        }
    }
    return images;
}

Score score(const AnnotatedImage& image, const std::vector<Post>& detections) {
    struct Match {
        std::size_t truth;
        std::size_t found;
        double mismatch;
    };
    std::vector<Match> matches;
    for (std::size_t t = 0; t < image.posts.size(); ++t) {
        for (std::size_t f = 0; f < detections.size(); ++f) {
            const double m = mismatch(image.posts[t], detections[f]);
            if (m <= 1.0) matches.push_back({t, f, m});
        }
    }
    std::sort(matches.begin(), matches.end(),
              [](const Match& a, const Match& b) { return a.mismatch < b.mismatch; });

    std::vector<bool> truth_used(image.posts.size(), false);
    std::vector<bool> found_used(detections.size(), false);
    Score result;
    for (const Match& m : matches) {
        if (truth_used[m.truth] || found_used[m.found]) continue;
        truth_used[m.truth] = found_used[m.found] = true;
        ++result.found;
    }
    result.missed = static_cast<int>(image.posts.size()) - result.found;
    for (std::size_t f = 0; f < detections.size(); ++f) {
        const bool ignored = std::any_of(image.ignore.begin(), image.ignore.end(), [&](const auto& box) {
            return box.contains(centre(detections[f]));
        });
        if (!found_used[f] && !ignored) ++result.wrong;
    }
    return result;
}

}  // namespace goalmouth::test
