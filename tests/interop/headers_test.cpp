// SPDX-License-Identifier: Apache-2.0
/// Programs include the public headers in any order, and link units that include different ones.
#include <gtest/gtest.h>

#include "interop/headers/units.hpp"

namespace gltfx {
namespace {

TEST(Headers, UnitsThatIncludeAllOfThemAgree) {
  EXPECT_TRUE(test::is_whole_forward(test::make_asset_backward()));
  EXPECT_TRUE(test::is_whole_backward(test::make_asset_forward()));
}

}  // namespace
}  // namespace gltfx
