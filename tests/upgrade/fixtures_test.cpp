// SPDX-License-Identifier: Apache-2.0
// The assets of fixtures/legacy become, byte for byte, what stands under upgraded/; those of
// on-request/ when they are asked for.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "container/container.hpp"
#include "support.hpp"
#include "upgrade/choice.hpp"
#include "upgrade/glb_rewrite.hpp"

namespace gltfx::upgrade::test {
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

container::Container read(const fs::path& file) {
  auto opened = container::open_file(file);
  EXPECT_TRUE(opened) << file;
  return *std::move(opened);
}

// What is upgraded on request only is upgraded when its name is given.
UpgradeOptions options_for(const std::string& name) {
  if (name.find("on-request/") == std::string::npos) return {};
  return only(legacy_names(*schema::builtin_set()));
}

std::string upgraded_bytes(const container::Container& file, const std::string& name) {
  const Upgraded result = upgraded(std::string(*file.json), options_for(name));
  return file.format == container::Format::glb ? *rewrite_glb(file, result.text) : result.text;
}

class LegacyFixture : public testing::TestWithParam<std::string> {};

TEST_P(LegacyFixture, BecomesWhatIsExpected) {
  const container::Container file = read(folder() / GetParam());
  const container::Container expected = read(folder() / "upgraded" / GetParam());
  EXPECT_EQ(upgraded_bytes(file, GetParam()), expected.bytes.text());
}

TEST_P(LegacyFixture, IsSettledAfterOneRun) {
  const container::Container done = read(folder() / "upgraded" / GetParam());
  EXPECT_EQ(upgraded_bytes(done, GetParam()), done.bytes.text());
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  const std::size_t begin = info.param.rfind('/') + 1;
  return info.param.substr(begin, info.param.find('.') - begin);
}

INSTANTIATE_TEST_SUITE_P(Upgrade, LegacyFixture, testing::ValuesIn(names()), test_name);

TEST(LegacyFixtures, WhatIsUpgradedOnRequestIsElseOnlyOffered) {
  for (const std::string& name : names()) {
    if (options_for(name).only.empty()) continue;
    const Upgraded result = upgraded(std::string(*read(folder() / name).json));
    EXPECT_TRUE(result.plan.edits.empty()) << name;
    for (const UpgradeAction& action : result.plan.actions) {
      EXPECT_EQ(action.fate, UpgradeFate::on_request) << name;
    }
  }
}

}  // namespace
}  // namespace gltfx::upgrade::test
