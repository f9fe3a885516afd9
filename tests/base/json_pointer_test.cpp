// SPDX-License-Identifier: Apache-2.0
#include "base/json_pointer.hpp"

#include <gmock/gmock.h>

namespace gltfx {
namespace {

using ::testing::ElementsAre;

TEST(Path, IsTheTextOfItsSteps) {
  const Path root;
  const Path nodes(root, "nodes");
  const Path node(nodes, 5);
  const Path extras(node, "a/b~c");
  EXPECT_EQ(root.pointer(), "");
  EXPECT_EQ(nodes.pointer(), "/nodes");
  EXPECT_EQ(node.pointer(), "/nodes/5");
  EXPECT_EQ(extras.pointer(), "/nodes/5/a~1b~0c");
  EXPECT_TRUE(node.is_index());
  EXPECT_EQ(node.index(), 5u);
  EXPECT_EQ(extras.key(), "a/b~c");
  EXPECT_EQ(extras.parent(), &node);
}

TEST(SplitPointer, UndoesTheEscapes) {
  EXPECT_TRUE(split_pointer("")->empty());
  EXPECT_THAT(*split_pointer("/"), ElementsAre(""));
  EXPECT_THAT(*split_pointer("/a/0/"), ElementsAre("a", "0", ""));
  EXPECT_THAT(*split_pointer("/a~1b/m~0n/~01"), ElementsAre("a/b", "m~n", "~1"));
}

TEST(SplitPointer, RefusesWhatIsNoPointer) {
  for (const std::string_view text : {"a", "a/b", "/~", "/~2", "/a~/b", " /a"}) {
    EXPECT_FALSE(split_pointer(text)) << text;
  }
}

TEST(PointerPattern, ReplacesIndicesOnly) {
  EXPECT_EQ(pointer_pattern(""), "");
  EXPECT_EQ(pointer_pattern("/nodes/5/mesh"), "/nodes/*/mesh");
  EXPECT_EQ(pointer_pattern("/a/12/3"), "/a/*/*");
  EXPECT_EQ(pointer_pattern("/TEXCOORD_0/x1/1x"), "/TEXCOORD_0/x1/1x");
  EXPECT_EQ(pointer_pattern("/a//b"), "/a//b");
}

}  // namespace
}  // namespace gltfx
