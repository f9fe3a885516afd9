// SPDX-License-Identifier: Apache-2.0
// Assets below an asset: where their references lead, and when two of them are one file.
#include "model/external_assets.hpp"

#include <map>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "container/container.hpp"

namespace gltfx {
namespace {

using Files = std::map<std::string, std::string>;

// An asset whose resolver reads `files`.
model::OpenedAsset open_asset_of(const Files& files, const std::string& name) {
  const auto read = [files](const std::string& path) -> std::optional<container::Bytes> {
    const auto file = files.find(path);
    if (file == files.end()) return std::nullopt;
    return container::Bytes::from_string(file->second);
  };
  return {
      name,
      container::open_bytes(container::Bytes::from_string(files.at(name)), container::Format::gltf),
      container::Resolver(read, container::ReadNames::paths)};
}

std::string text_of(const Result<model::ReferredFile>& file) {
  return file ? std::string(file->bytes.text()) : "error: " + file.error().message;
}

constexpr const char* kChild = R"({"asset":{"version":"2.1"},"files":[{"uri":"x.txt"}]})";

TEST(ExternalAssets, ResolveAgainstTheirOwnFolder) {
  const Files files{{"a.gltf", R"({"files":[{"uri":"sub/b.gltf"}],"externalAssets":[{"file":0}]})"},
                    {"sub/b.gltf", R"({"files":[{"uri":"../x.txt"},{"uri":"x.txt"}]})"},
                    {"x.txt", "outer"},
                    {"sub/x.txt", "inner"}};
  const model::OpenedAsset opened = open_asset_of(files, "a.gltf");
  model::ExternalAssets assets(opened);
  EXPECT_EQ(assets.root().file_of(0), 0U);
  const auto& child = assets.asset(assets.root(), 0);
  ASSERT_TRUE(child);
  EXPECT_EQ((*child)->asset().name(), "sub/b.gltf");
  EXPECT_EQ(text_of(assets.file(**child, 0)), "outer");
  EXPECT_EQ(text_of(assets.file(**child, 1)), "inner");
}

TEST(ExternalAssets, ReadAliasesInTheReferredFileOnly) {
  const Files files{{"a.gltf", R"({"files":[{"uri":"b.gltf","aliases":[{"alias":"x.txt","file":1}]},
                              {"uri":"y.txt"}]})"},
                    {"b.gltf", R"({"files":[{"uri":"x.txt"},{"uri":"./x.txt"},{"uri":"c.gltf"}]})"},
                    {"c.gltf", kChild},
                    {"x.txt", "x"},
                    {"y.txt", "y"}};
  const model::OpenedAsset opened = open_asset_of(files, "a.gltf");
  model::ExternalAssets assets(opened);
  const auto& child = assets.asset(assets.root(), 0);
  ASSERT_TRUE(child);
  EXPECT_EQ(text_of(assets.file(**child, 0)), "y");
  EXPECT_EQ(text_of(assets.file(**child, 1)), "x") << "another spelling";
  const auto& grandchild = assets.asset(**child, 2);
  ASSERT_TRUE(grandchild);
  EXPECT_EQ(text_of(assets.file(**grandchild, 0)), "x");
}

TEST(ExternalAssets, AreOpenedOnceWhateverTheirNames) {
  const Files files{{"a.gltf", R"({"files":[{"uri":"./s/../b.gltf"},{"uri":"%62.gltf"}]})"},
                    {"b.gltf", R"({"files":[{"uri":"a.gltf"}]})"}};
  const model::OpenedAsset opened = open_asset_of(files, "a.gltf");
  model::ExternalAssets assets(opened);
  const auto& one = assets.asset(assets.root(), 0);
  const auto& other = assets.asset(assets.root(), 1);
  ASSERT_TRUE(one);
  ASSERT_TRUE(other);
  EXPECT_EQ(*one, *other);
  const auto& cycle = assets.asset(**one, 0);
  ASSERT_TRUE(cycle);
  EXPECT_EQ(*cycle, &assets.root());
}

TEST(ExternalAssets, EmbeddedInTheAssetHaveItsFolder) {
  const Files files{
      {"a.gltf", std::string(R"({"buffers":[{"byteLength":54,"uri":"data:,)") +
                     "%7b%22asset%22%3a%7b%22version%22%3a%222.1%22%7d%2c%22files%22%3a%5b%7b%22"
                     "uri%22%3a%22x.txt%22%7d%5d%7d" +
                     R"("}],"bufferViews":[{"buffer":0,"byteLength":53}],
                        "files":[{"bufferView":0,"mimeType":"model/gltf+json"}]})"},
      {"x.txt", "x"}};
  const model::OpenedAsset opened = open_asset_of(files, "a.gltf");
  model::ExternalAssets assets(opened);
  const auto& child = assets.asset(assets.root(), 0);
  ASSERT_TRUE(child) << child.error().message;
  EXPECT_EQ((*child)->asset().name(), "a.gltf#/files/0");
  EXPECT_EQ(text_of(assets.file(**child, 0)), "x");
}

TEST(ExternalAssets, SayWhyThereAreNone) {
  const Files files{{"a.gltf", R"({"files":[{"uri":"b.gltf"},{"uri":"file:///c.gltf"}]})"}};
  const model::OpenedAsset opened = open_asset_of(files, "a.gltf");
  model::ExternalAssets assets(opened);
  EXPECT_FALSE(assets.asset(assets.root(), 0));
  EXPECT_FALSE(assets.asset(assets.root(), 1));
  EXPECT_FALSE(assets.asset(assets.root(), 2));
}

}  // namespace
}  // namespace gltfx
