// SPDX-License-Identifier: Apache-2.0
// Extras and foreign extensions of a deleted object are not lost.
#include "change/lost_content.hpp"

#include <gmock/gmock.h>

#include "json/parse.hpp"
#include "schema/compile.hpp"

namespace gltfx::change {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> foreign(const std::string& object) {
  const json::Parsed parsed = json::parse(std::string_view(object));
  EXPECT_TRUE(parsed.ok()) << object;
  const schema::Set& set = *schema::builtin_set();
  return foreign_content(parsed.document, set, parsed.document.root(),
                         set.find_type("material.KHR_materials_translucency"));
}

TEST(Removal, ForeignIsWhatTheExtensionDoesNotDescribe) {
  EXPECT_THAT(foreign(R"({"translucencyFactor":1,"translucencyTexture":{"index":0}})"), IsEmpty());
  EXPECT_THAT(foreign(R"({"extras":{},"extensions":{}})"), IsEmpty());
  EXPECT_THAT(
      foreign(R"({"extras":7,"extensions":{"ACME_a":{},"KHR_texture_transform":{}},"b":1})"),
      ElementsAre("extras", "'ACME_a'", "'KHR_texture_transform'", "'b'"));
  EXPECT_THAT(foreign(R"({"translucencyTexture":{"index":0,"extras":{"a":1},"extensions":)"
                      R"({"KHR_texture_transform":{"extras":{"b":2}},"ACME_a":{}}}})"),
              ElementsAre("extras", "'ACME_a'"));
  EXPECT_THAT(foreign("7"), IsEmpty());
}

TEST(Removal, ExtensionsAreTakenOutWithTheirLastObject) {
  const std::string text =
      R"({"a":{"extensions":{"X":{},"Y":{}}},"b":{"extensions":{"Y":{}}},)"
      R"("c":[{"extensions":{"Z":{"extensions":{"W":{}}}}}],"extras":{"extensions":{"X":{}}}})";
  const json::Parsed parsed = json::parse(std::string_view(text));
  const json::Document& document = parsed.document;
  const auto taken_out = [&](const std::vector<const char*>& pointers) {
    std::vector<json::NodeId> values;
    for (const char* pointer : pointers) values.push_back(document.resolve(pointer));
    std::vector<std::string> names;
    for (const auto& [name, value] : extensions_taken_out(document, values)) names.push_back(name);
    return names;
  };
  EXPECT_THAT(taken_out({}), IsEmpty());
  EXPECT_THAT(taken_out({"/a"}), ElementsAre("X"));
  EXPECT_THAT(taken_out({"/a/extensions"}), ElementsAre("X"));
  EXPECT_THAT(taken_out({"/a/extensions/X"}), IsEmpty());
  EXPECT_THAT(taken_out({"/b", "/a", "/a/extensions"}), ElementsAre("X", "Y"));
  EXPECT_THAT(taken_out({"/c/0", "/c/0/extensions/Z"}), ElementsAre("W", "Z"));
}

}  // namespace
}  // namespace gltfx::change
