// SPDX-License-Identifier: Apache-2.0
// The assets of fixtures/legacy become, byte for byte, what stands under upgraded/; those of
// on-request/ when they are asked for.
#include <algorithm>

#include "legacy_asset.hpp"
#include "schema/compile.hpp"
#include "steps/upgrade/choice.hpp"

namespace gltfx::test {
namespace {

namespace fs = std::filesystem;

fs::path folder() { return fs::path(GLTFX_SOURCE_DIR) / "fixtures" / "legacy"; }

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const char* part : {"", "on-request/"}) {
    for (const auto& entry : fs::directory_iterator(folder() / part)) {
      const std::string ending = entry.path().extension();
      const std::string name = entry.path().filename();
      if (ending == ".gltf" || ending == ".glb") all.push_back(part + name);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

// Images as their texels: which bytes a PNG of them has is up to the zlib that packs them.
std::string with_texels(std::string text) {
  constexpr std::string_view kData = "data:image/png;base64,";
  for (std::size_t at = text.find(kData); at != std::string::npos; at = text.find(kData, at)) {
    const std::size_t end = text.find('"', at);
    const std::size_t begin = at + kData.size();
    const auto file = container::decode_base64(std::string_view(text).substr(begin, end - begin));
    std::string texels;
    if (file) {
      const codec::Image image = decoded(*file);
      texels = fmt::format("{}x{}x{}:", image.width, image.height, image.channels);
      for (const std::byte value : image.pixels)
        texels += fmt::format("{:02x}", static_cast<unsigned>(value));
    }
    text.replace(at, end - at, texels);
  }
  return text;
}

// What is upgraded on request only is upgraded when its name is given.
UpgradeOptions options_for(const std::string& name) {
  UpgradeOptions options;
  if (name.starts_with("on-request/")) {
    options.only = upgrade::legacy_names(*schema::builtin_set());
  }
  return options;
}

class LegacyFixture : public testing::TestWithParam<std::string> {
 protected:
  std::string upgraded(const fs::path& path) const {
    UpgradeOptions options = options_for(GetParam());
    options.output = (folder_.path() / path.filename()).native();
    const UpgradeReport report = upgrade_file(path.native(), options);
    EXPECT_TRUE(report.written) << report.error;
    return content(options.output);
  }

  const TempFolder folder_;
};

TEST_P(LegacyFixture, BecomesWhatIsExpected) {
  EXPECT_EQ(with_texels(upgraded(folder() / GetParam())),
            with_texels(content(folder() / "upgraded" / GetParam())));
}

TEST_P(LegacyFixture, IsSettledAfterOneRun) {
  const fs::path done = folder() / "upgraded" / GetParam();
  EXPECT_EQ(upgraded(done), content(done));
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  const std::size_t begin = info.param.rfind('/') + 1;
  return info.param.substr(begin, info.param.find('.') - begin);
}

INSTANTIATE_TEST_SUITE_P(Upgrade, LegacyFixture, testing::ValuesIn(names()), test_name);

TEST(LegacyFixtures, WhatIsUpgradedOnRequestIsElseOnlyOffered) {
  for (const std::string& name : names()) {
    if (options_for(name).only.empty()) continue;
    const UpgradeReport report = upgrade_file((folder() / name).native());
    EXPECT_FALSE(report.changes) << name;
    for (const UpgradeAction& action : report.actions) {
      EXPECT_EQ(action.outcome, UpgradeOutcome::on_request) << name;
    }
  }
}

}  // namespace
}  // namespace gltfx::test
