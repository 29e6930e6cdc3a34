#include "core/refinement/edge_consensus.h"

#include "core/refinement/row_purity.h"

#include <algorithm>
#include <cmath>

namespace goalmouth {
namespace {

constexpr std::size_t longest_piece = 8;  // rows
constexpr double reach = 3.0;             // px, over which places that are wrong are spread
constexpr double unshared = 0.04;         // px, sigma of a run's place beside its rows' noise
constexpr double transition = 2.0;        // rows of a run that look like its neighbours in part
// Farther in something may lie over the post; farther out something behind it would have to be of its hue and
// as bright. Odds of that, as ln 5.
constexpr double hue_alike = 1.6;
constexpr double least_clean = 0.25;

bool counts(const EdgeRows& rows, std::size_t i) {
    return rows.told(i) && static_cast<double>(rows.clean[i]) > least_clean;
}

/// Square of how far the backgrounds of two rows differ.
double unlike(const EdgeRows& rows, std::size_t a, std::size_t b) {
    double sum = 0.0;
    for (const RowColumn<float>& part : rows.background) {
        const double d = static_cast<double>(part[a] - part[b]);
        sum += d * d;
    }
    return sum;
}

}  // namespace

void EdgeConsensus::split(const EdgeRows& rows, std::vector<Piece>& pieces) {
    pieces.clear();
    // What backgrounds usually change from row to row is noise.
    counting_.clear();
    for (std::size_t i = 0; i < rows.count; ++i)
        if (counts(rows, i)) counting_.push_back(i);
    changes_.assign(counting_.size(), 0.0);
    changes_of_neighbours_.clear();
    for (std::size_t n = 1; n < counting_.size(); ++n) {
        changes_[n] = unlike(rows, counting_[n], counting_[n - 1]);
        if (counting_[n] == counting_[n - 1] + 1)
            changes_of_neighbours_.push_back(static_cast<float>(changes_[n]));
    }
    const std::size_t neighbours = changes_of_neighbours_.size();
    changes_of_neighbours_.resize(neighbours + EdgeRows::block);  // read by vectors
    const float middle =
        neighbours > 0 ? nth_smallest(changes_of_neighbours_.data(), neighbours, neighbours / 2) : 0.0F;
    const double usual = 4.0 * std::sqrt(static_cast<double>(middle)) + 2.0;

    std::size_t run_start = 0;  // its first piece
    Piece piece;
    double weights = 0.0;
    const auto end_piece = [&] {
        if (piece.rows > 0.0) {
            piece.place /= weights;
            piece.turn /= weights;
            piece.variance = 1.0 / weights;
            pieces.push_back(piece);
        }
        piece = {};
        weights = 0.0;
    };
    const auto end_run = [&] {
        end_piece();
        double n = 0.0, w = 0.0;
        for (std::size_t k = run_start; k < pieces.size(); ++k)
            n += pieces[k].rows, w += 1.0 / pieces[k].variance;
        const double told =
            w > 0.0 ? std::log(1.0 + reach / (2.5066 * std::sqrt(1.0 / w + unshared * unshared))) : 0.0;
        for (std::size_t k = run_start; k < pieces.size(); ++k) {
            pieces[k].share = told * pieces[k].rows / (n + transition);
            pieces[k].variance += unshared * unshared;
            pieces[k].per_square = 1.0 / (9.0 * pieces[k].variance);
        }
        run_start = pieces.size();
    };
    for (std::size_t n = 0; n < counting_.size(); ++n) {
        const std::size_t i = counting_[n];
        const double variance = rows.variance(i), offset = static_cast<double>(rows.measured.offset[i]);
        const double weight = 1.0 / variance;
        if (changes_[n] > usual * usual) end_run();
        if (piece.rows > 0.0) {
            // Where the edge jumps something else begins, whatever the background looks like.
            const double own_variance = 1.0 / weights;
            const double jump = offset - piece.place * own_variance;
            const bool jumps = jump * jump > 16.0 * (variance + own_variance);
            if (jumps) end_run();
        }
        if (piece.rows >= static_cast<double>(longest_piece)) end_piece();
        if (piece.rows == 0.0) piece.first = i;
        piece.last = i;
        piece.rows += 1.0;
        piece.place += offset * weight;
        piece.turn += static_cast<double>(rows.turn[i]) * weight;
        weights += weight;
    }
    end_run();
}

double EdgeConsensus::evidence(const std::vector<Piece>& pieces, double place, double turn) {
    double sum = 0.0;
    for (const Piece& p : pieces) {
        const double miss = p.place - place - turn * p.turn;
        sum += p.share * std::max(0.0, 1.0 - miss * miss * p.per_square);
    }
    return sum;
}

EdgeConsensus::Result EdgeConsensus::find(std::array<EdgeRows, 2>& rows, double roll, double sigma) {
    Result result;
    double longest = 0.0;
    for (EdgeRows& side : rows)
        for (std::size_t i = 0; i < side.count; ++i) {
            // What was outvoted before is asked anew.
            if (side.outvoted[i] > 0.0F) side.outvoted[i] = 0.0F, side.weight[i] = side.clean[i];
            if (counts(side, i)) longest = std::max(longest, std::abs(static_cast<double>(side.turn[i])));
        }
    if (!(longest > 0.0)) return result;
    for (std::size_t side = 0; side < 2; ++side) split(rows[side], pieces_[side]);

    const auto agrees = [](const Piece& p) { return p.place * p.place < 9.0 * p.variance; };
    if (std::all_of(pieces_[0].begin(), pieces_[0].end(), agrees) &&
        std::all_of(pieces_[1].begin(), pieces_[1].end(), agrees))
        return result;  // with one another, and with the fit so far

    for (std::size_t side = 0; side < 2; ++side) {
        columns_[side].assign(pieces_[side].size());
        for (std::size_t k = 0; k < pieces_[side].size(); ++k) {
            const Piece& p = pieces_[side][k];
            columns_[side].place[k] = static_cast<float>(p.place);
            columns_[side].turn[k] = static_cast<float>(p.turn);
            columns_[side].per_square[k] = static_cast<float>(p.per_square);
            columns_[side].share[k] = static_cast<float>(p.share);
        }
    }
    for (std::size_t side = 0; side < 2; ++side) evidence_[side].assign(pieces_[side].size());
    constexpr double most = 3.0, step = 0.15;  // px, at the edges' ends
    double best = -1e9, best_turn = 0.0;
    std::array<double, 2> place{};
    for (double end = -most; end <= most + 1e-9; end += step) {
        const double turn = end / longest;
        double sum = 0.0;
        for (std::size_t side = 0; side < 2; ++side)
            sum += static_cast<double>(
                evidence_of_places(columns_[side], static_cast<float>(turn), evidence_[side]));
        const double leaves = (roll + turn) / sigma;
        sum -= 0.5 * leaves * leaves + 1e-3 * std::abs(end);  // of equals the least
        if (!(sum > best)) continue;
        best = sum, best_turn = turn, place = {};
        for (std::size_t side = 0; side < 2; ++side) {
            float most_here = 0.0F;
            for (std::size_t k = 0; k < pieces_[side].size(); ++k) {
                if (!(evidence_[side][k] > most_here)) continue;
                most_here = evidence_[side][k];
                place[side] = pieces_[side][k].place - turn * pieces_[side][k].turn;
            }
        }
    }
    for (std::size_t side = 0; side < 2; ++side) {
        result.evidence[side] = evidence(pieces_[side], place[side], best_turn);
        for (const Piece& p : pieces_[side]) {
            const double a = p.place - best_turn * p.turn;
            const double apart = a - place[side];
            if (apart * apart < 18.0 * p.variance) continue;
            result.disagree = true;
            const double against = evidence(pieces_[side], a, best_turn) - (apart < 0.0 ? hue_alike : 0.0);
            result.rival[side] = std::max(result.rival[side], against);
        }
    }
    if (!result.disagree) return result;
    for (std::size_t side = 0; side < 2; ++side) {
        EdgeRows& all = rows[side];
        for (std::size_t i = 0; i < all.count; ++i) all.weight[i] = 0.0F, all.outvoted[i] = 1.0F;
        for (const Piece& p : pieces_[side]) {
            const double miss = p.place - place[side] - best_turn * p.turn;
            if (miss * miss > 9.0 * p.variance) continue;
            for (std::size_t i = p.first; i <= p.last; ++i)
                if (counts(all, i)) all.weight[i] = 1.0F, all.outvoted[i] = 0.0F;
        }
    }
    return result;
}

}  // namespace goalmouth
