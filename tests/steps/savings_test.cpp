// SPDX-License-Identifier: Apache-2.0
// A dry run without steps tells what options would save.
#include <algorithm>

#include <gmock/gmock.h>

#include "geometry_support.hpp"
#include "made_asset.hpp"

namespace gltfx::test {
namespace {

using testing::IsEmpty;

class Savings : public testing::Test {
 protected:
  // A triangle whose vertices are there twice, and an accessor that nothing uses.
  Savings() {
    std::vector<float> positions;
    for (int i = 0; i < 600; ++i) positions.push_back(static_cast<float>(i % 9 % 4));
    OrderedJson primitive;
    primitive["attributes"]["POSITION"] = asset_.accessor(positions, "VEC3", true);
    asset_.mesh(primitive);
    asset_.json["scenes"] = {{{"nodes", {0}}}};
    unused_ = asset_.accessor(std::vector<float>(300), "VEC3");
  }
  ConvertReport run(const ConvertOptions& options) {
    return convert_file(folder_.write("a.glb", asset_.glb()).native(), options);
  }
  static const ConvertSaving* find(const ConvertReport& report, std::string_view option) {
    const auto found = std::find_if(report.savings.begin(), report.savings.end(),
                                    [&](const auto& each) { return each.option == option; });
    return found == report.savings.end() ? nullptr : &*found;
  }

  container::test::TempFolder folder_;
  MadeAsset asset_;
  std::size_t unused_ = 0;
};

TEST_F(Savings, AreThoseOfTheSteps) {
  const ConvertReport report = run({});
  EXPECT_FALSE(report.changes);
  for (const auto& [option, flag] :
       {std::pair("--prune", &ConvertOptions::prune), std::pair("--weld", &ConvertOptions::weld)}) {
    ConvertOptions options;
    options.*flag = true;
    const ConvertReport done = run(options);
    ASSERT_EQ(done.steps.size(), 1U);
    const ConvertSaving* saving = find(report, option);
    ASSERT_NE(saving, nullptr) << option;
    EXPECT_EQ(saving->bytes, done.steps[0].bytes_before - done.steps[0].bytes_after) << option;
    EXPECT_THAT(done.savings, IsEmpty());
  }
  EXPECT_GT(find(report, "--weld")->gpu_bytes, 0U);
  EXPECT_GT(report.gpu_mesh_bytes, find(report, "--weld")->gpu_bytes);
}

TEST_F(Savings, AreNotToldWhereNothingIsSaved) {
  EXPECT_EQ(find(run({}), "--resample"), nullptr);
  EXPECT_EQ(find(run({}), "--texture-size 1024"), nullptr);
}

}  // namespace
}  // namespace gltfx::test
