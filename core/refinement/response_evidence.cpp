#include "core/refinement/response_evidence.h"

#include "core/refinement/along_edges.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace goalmouth {
namespace {

constexpr int most_rows = 96;
constexpr double clear = 3.5, reach = 7.5;  // px beside an edge: one colour there, its blur is over
constexpr double mixed = 2.5;               // px beside an edge: both colours

// A fifth of the edges tell something else than a camera's response: anything over a range of two.
constexpr double else_share = 0.2, else_range = 2.0;
constexpr double peak = 0.39894;      // of a normal density
constexpr double model = 0.1;         // sigma of the bow itself, of a camera's own curve
constexpr double beyond_doubt = 5.0;  // more than one edge tells

using Complement = Eigen::Matrix<float, 2, 3>;

/// S with SᵀS = M: what tells post from background, in sigmas of a pair's noise.
Complement complement_of(const Eigen::Matrix3f& contrast) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> eigen(contrast);  // ascending; the shading's is 0
    Complement s;
    for (int i = 0; i < 2; ++i)
        s.row(i) = std::sqrt(std::max(0.0F, eigen.eigenvalues()[i + 1])) *
                   eigen.eigenvectors().col(i + 1).transpose();
    return s;
}

/// Pairs next to one another.
struct Span {
    int first = 0, last = -1;

    int pairs() const { return std::max(0, last - first + 1); }
    PairColour mean(const PairRow& row) const {
        PairColour sum = PairColour::Zero();
        row.add(first, last, sum);
        return sum / static_cast<float>(pairs());
    }
};

/// Those of a row of which the middle lies between two places [px] beside an edge.
Span span(double edge, double one, double other, int pairs) {
    const double from = edge + std::min(one, other), to = edge + std::max(one, other);
    return {std::max(0, whole_above(0.5 * (from - 0.5))), std::min(pairs - 1, whole_below(0.5 * (to - 0.5)))};
}

class Bow {
  public:
    explicit Bow(const PostColour& colour) : colour_(colour), complement_(complement_of(colour.contrast)) {}

    /// One row of an edge at `edge` [px]; `inside`: px to the post's middle.
    void add(const PairRow& row, int pairs, double edge, double outwards, double inside,
             BowEvidence& evidence) {
        const Span outer = span(edge, outwards * clear, outwards * reach, pairs);
        if (outer.pairs() == 0) return;
        const Span inner =
            span(edge, -outwards * std::min(clear, inside), -outwards * std::min(reach, inside + 1.0), pairs);
        const PairColour background = outer.mean(row);
        const PairColour post = inner.pairs() > 0 ? inner.mean(row) : colour_.mean;
        const Eigen::Vector2f way = complement_ * (background - post);
        const float length = way.norm();
        constexpr float least_contrast = 6.0F;
        if (!(length > least_contrast)) return;
        const Eigen::Vector2f along = way / length, across(-along.y(), along.x());
        const PairColour half = 0.5F * (post + background);
        const PairColour light = 0.5F * (light_of_level(post) + light_of_level(background));
        const float bow = across.dot(complement_ * (level_of_light(light) - half));
        double pull = 0.0, information = 0.0;
        const Span both = span(edge, -mixed, mixed, pairs);
        for (int pair = both.first; pair <= both.last; ++pair) {
            const Eigen::Vector2f at = complement_ * (row[pair] - post);
            const float share = at.dot(along) / length;
            if (!(share > 0.1F && share < 0.9F)) continue;
            const float expected = 4.0F * share * (1.0F - share) * bow;
            // A third colour in between is neither.
            const float measured = at.dot(across);
            const float most = 6.0F + 2.0F * std::abs(bow);
            if (std::abs(measured) > most) continue;
            pull += static_cast<double>(measured * expected);
            information += static_cast<double>(expected * expected);
        }
        evidence.add(pull, information);
    }

  private:
    const PostColour& colour_;
    Complement complement_;
};

}  // namespace

void BowEvidence::add(double pull, double information) {
    pull_ += pull;
    information_ += information;
    pull_square_ += pull * pull;
    pull_information_ += pull * information;
    information_square_ += information * information;
}

double BowEvidence::share() const {
    return information_ > 0.0 ? pull_ / information_ : 0.0;
}

double BowEvidence::sigma() const {
    // What rows leave of pull = share · information, squared and summed.
    const double rest =
        pull_square_ - 2.0 * share() * pull_information_ + share() * share() * information_square_;
    return information_ > 0.0 ? std::sqrt(std::max(0.0, rest)) / information_ : 0.0;
}

double BowEvidence::odds() const {
    if (!(information_ > 0.0)) return 0.0;
    // Of a few rows the scatter says little: no better than the noise allows.
    const double sure = std::hypot(std::max(sigma(), 1.0 / std::sqrt(information_)), model);
    const auto likelihood = [&](double expected) {
        const double off = (share() - expected) / sure;
        return (1.0 - else_share) * peak / sure * std::exp(-0.5 * off * off) + else_share / else_range;
    };
    return std::log(likelihood(1.0) / likelihood(0.0));
}

bool ResponseEvidence::open(std::size_t edges) const {
    static const double most_of_one =
        std::log((1.0 - else_share) * peak / model * else_range / else_share + 1.0);
    return odds_ + most_of_one * static_cast<double>(edges) > beyond_doubt;
}

CameraResponse ResponseEvidence::response() const {
    return odds_ > beyond_doubt ? CameraResponse::srgb : CameraResponse::linear;
}

ResponseEvidence response_evidence(YuyvView image, const RoughOutline& outline, const PostColour& colour,
                                   const Intrinsics& camera, const CoarseEdgeFinder::Edges& edges) {
    Bow bow(colour);
    std::array<BowEvidence, 2> sides;
    const int pairs = image.width / 2;
    along_edges(outline, camera, edges, most_rows, [&](const EdgeRow& at) {
        bow.add(PairRow(image.row(at.y), pairs, CameraResponse::linear), pairs, at.edge, at.outwards(),
                at.inside, sides[at.side]);
    });
    return {sides[0], sides[1]};
}

}  // namespace goalmouth
