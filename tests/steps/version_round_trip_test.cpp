// SPDX-License-Identifier: Apache-2.0
// All fixtures without errors go to glTF 2.1 and back. The text is the same, but for targets of
// views that have no vertex data.
#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>

#include "convert_support.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using container::test::TempFolder;
using test::OrderedJson;
using test::StoredAsset;

std::vector<fs::path> assets_of_version_2() {
  std::vector<fs::path> assets;
  for (const char* name : {"good", "legacy"}) {
    const fs::path folder = fs::path(GLTFX_SOURCE_DIR) / "fixtures" / name;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const std::string ending = entry.path().extension().native();
      if (ending == ".gltf" || ending == ".glb") assets.push_back(entry.path());
    }
  }
  std::sort(assets.begin(), assets.end());
  return assets;
}

OrderedJson without_targets(const std::string& text) {
  OrderedJson json = OrderedJson::parse(text);
  if (!json.contains("bufferViews")) return json;
  for (auto& view : json["bufferViews"]) view.erase("target");
  return json;
}

TEST(VersionRoundTrip, GivesTheSameText) {
  std::size_t same = 0;
  for (const fs::path& path : assets_of_version_2()) {
    const TempFolder folder;
    for (const char* name : {"up", "back"}) fs::create_directories(folder.path() / name);
    UpgradeOptions up;
    up.gltf = "2.1";
    up.output = (folder.path() / "up" / path.filename()).native();
    const UpgradeReport raised = upgrade_file(path.native(), up);
    ASSERT_TRUE(raised.written) << path << ": " << raised.error;
    const fs::path back = folder.path() / "back" / path.filename();
    ConvertOptions down = test::options_to(back);
    down.later.gltf = "2.0";
    const ConvertReport lowered = convert_file(up.output, down);
    ASSERT_TRUE(lowered.written) << path << ": " << lowered.error;
    const std::string before = StoredAsset::at(path).text, after = StoredAsset::at(back).text;
    EXPECT_EQ(without_targets(before), without_targets(after)) << path;
    if (raised.due() > 1) continue;
    EXPECT_EQ(before, after) << path;
    ++same;
  }
  EXPECT_GT(same, 20U);
}

}  // namespace
}  // namespace gltfx
