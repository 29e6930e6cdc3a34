#include "core/refinement/piece_evidence.h"

// Before Highway:
#include "core/segmentation/vector_targets.h"
//
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/refinement/piece_evidence.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace goalmouth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// No fused multiply-add: every kind of vector gives the same numbers.
float evidence_of_places(const EdgePieceColumns& pieces, float turn, RowColumn<float>& evidence) {
    const hn::CappedTag<float, EdgeRows::block> d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F);
    auto most = zero;
    for (std::size_t i = 0; i < pieces.count; i += hn::Lanes(d)) {
        const auto at = hn::Sub(hn::LoadU(d, pieces.place.data() + i),
                                hn::Mul(hn::LoadU(d, pieces.turn.data() + i), hn::Set(d, turn)));
        auto sum = zero;
        for (std::size_t k = 0; k < pieces.count; ++k) {
            const auto miss = hn::Sub(hn::Set(d, pieces.place[k] - turn * pieces.turn[k]), at);
            const auto far = hn::Mul(hn::Mul(miss, miss), hn::Set(d, pieces.per_square[k]));
            sum = hn::Add(sum, hn::Mul(hn::Set(d, pieces.share[k]), hn::Max(zero, hn::Sub(one, far))));
        }
        hn::StoreU(sum, d, evidence.data() + i);
        most = hn::Max(most, hn::IfThenElseZero(hn::FirstN(d, pieces.count - i), sum));
    }
    return hn::GetLane(hn::MaxOfLanes(d, most));
}

}  // namespace goalmouth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace goalmouth {

HWY_EXPORT(evidence_of_places);

float evidence_of_places(const EdgePieceColumns& pieces, float turn, RowColumn<float>& evidence) {
    return HWY_DYNAMIC_DISPATCH(evidence_of_places)(pieces, turn, evidence);
}

void EdgePieceColumns::assign(std::size_t pieces) {
    count = pieces;
    for (RowColumn<float>* column : {&place, &turn, &per_square, &share}) column->assign(pieces);
}

}  // namespace goalmouth
#endif
