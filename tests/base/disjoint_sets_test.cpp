// SPDX-License-Identifier: Apache-2.0
#include "base/disjoint_sets.hpp"

#include <gtest/gtest.h>

namespace gltfx {
namespace {

TEST(DisjointSets, AGroupIsNamedByItsLeastThing) {
  DisjointSets sets(5);
  EXPECT_TRUE(sets.join(4, 2));
  EXPECT_TRUE(sets.join(3, 4));
  EXPECT_FALSE(sets.join(2, 3)) << "they are one already";
  EXPECT_EQ(sets.find(4), 2U);
  EXPECT_EQ(sets.find(1), 1U);
  EXPECT_EQ(sets.add(), 5U);
  EXPECT_TRUE(sets.join(5, 0));
  EXPECT_EQ(sets.find(5), 0U);
}

}  // namespace
}  // namespace gltfx
