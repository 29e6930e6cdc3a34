#pragma once

#include <cstdint>
#include <hwy/highway.h>

#include <gtest/gtest.h>

namespace goalmouth::test {

/// Runs `check` once for each kind of vector instructions that code built on Highway was compiled for and
/// this machine has, down to the plain C++ that stands in where there is none.
template <class Check>
void on_each_vector_target(Check check) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        SCOPED_TRACE(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(target);
        check();
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
}

}  // namespace goalmouth::test
