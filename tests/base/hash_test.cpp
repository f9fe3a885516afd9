// SPDX-License-Identifier: Apache-2.0
#include "base/hash.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gltfx {
namespace {

TEST(ContentHash, StaysTheSameForGood) {
  EXPECT_EQ(content_hash(""), content_hash({}));
  EXPECT_NE(content_hash(std::string(1, '\0')), content_hash(std::string(2, '\0')));
  EXPECT_EQ(fmt::format("{:016x}", content_hash("gltfx")), "d479cc4a58ddefe0");
}

}  // namespace
}  // namespace gltfx
