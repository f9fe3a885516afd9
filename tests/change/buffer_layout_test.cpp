// SPDX-License-Identifier: Apache-2.0
// Who names bytes of buffers.
#include "change/buffer_layout.hpp"

#include <gtest/gtest.h>

#include "json/parse.hpp"
#include "schema/compile.hpp"

namespace gltfx::change {
namespace {

Result<std::vector<BufferUser>> users_in(const std::string& text) {
  const json::Parsed parsed = json::parse(text);
  const auto set = schema::builtin_set();
  return buffer_users(graph::Graph(parsed.document, *set));
}

TEST(BufferUsers, AreViewsWithTheirBytes) {
  const auto users = users_in(R"({"buffers":[{"byteLength":8},{"byteLength":8}],
    "bufferViews":[{"buffer":1,"byteOffset":2,"byteLength":3}]})");
  ASSERT_TRUE(users);
  ASSERT_EQ(users->size(), 1U);
  EXPECT_EQ(users->front().buffer, 1U);
  EXPECT_EQ(users->front().bytes.begin, 2U);
  EXPECT_EQ(users->front().bytes.end, 5U);
}

TEST(BufferUsers, ABrokenIndexIsAnError) {
  for (const char* buffers : {"", R"("buffers":[],)", R"("buffers":{},)", R"("buffers":[{}],)"}) {
    const auto users =
        users_in("{" + std::string(buffers) + R"("bufferViews":[{"buffer":99,"byteLength":3}]})");
    ASSERT_FALSE(users) << buffers;
    EXPECT_EQ(users.error().message, "/bufferViews/0 does not define which bytes it uses");
  }
}

}  // namespace
}  // namespace gltfx::change
