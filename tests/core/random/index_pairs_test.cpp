#include "core/random/index_pairs.h"

#include "tests/support/vector_targets.h"

#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(IndexPairs, AreTheIndicesDrawnOneByOne) {
    test::on_each_vector_target([] {
        // Of the largest counts a good part of the draws is repeated.
        for (const std::uint32_t count : {2U, 3U, 50U, 1000U, 70000U, 300000000U, 3000000000U, 4294967295U}) {
            for (const std::size_t pairs : {0U, 1U, 3U, 50U, 64U, 65U, 200U}) {
                Random together(count + pairs);
                Random one_by_one = together;
                std::vector<std::uint64_t> indices(2 * pairs + 8);
                draw_index_pairs(together, count, pairs, indices.data());
                for (std::size_t i = 0; i < 2 * pairs; i += 2) {
                    ASSERT_EQ(indices[i], one_by_one.index(count)) << count;
                    ASSERT_EQ(indices[i + 1], one_by_one.index(count - 1)) << count;
                }
                ASSERT_EQ(together.bits(), one_by_one.bits()) << count;
            }
        }
    });
}

}  // namespace
}  // namespace goalmouth
