// SPDX-License-Identifier: Apache-2.0
// The assets of fixtures/legacy become, byte for byte, what stands under upgraded/.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "container/container.hpp"
#include "support.hpp"
#include "upgrade/glb_rewrite.hpp"

namespace gltfx::upgrade::test {
namespace {

namespace fs = std::filesystem;

fs::path folder() { return fs::path(GLTFX_SOURCE_DIR) / "fixtures" / "legacy"; }

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& entry : fs::directory_iterator(folder())) {
    const std::string ending = entry.path().extension();
    if (ending == ".gltf" || ending == ".glb") all.push_back(entry.path().filename());
  }
  std::sort(all.begin(), all.end());
  return all;
}

container::Container read(const fs::path& file) {
  auto opened = container::open_file(file);
  EXPECT_TRUE(opened) << file;
  return *std::move(opened);
}

std::string upgraded_bytes(const container::Container& file) {
  const Upgraded result = upgraded(std::string(*file.json));
  return file.format == container::Format::glb ? *rewrite_glb(file, result.text) : result.text;
}

class LegacyFixture : public testing::TestWithParam<std::string> {};

TEST_P(LegacyFixture, BecomesWhatIsExpected) {
  const container::Container file = read(folder() / GetParam());
  const container::Container expected = read(folder() / "upgraded" / GetParam());
  EXPECT_EQ(upgraded_bytes(file), expected.bytes.text());
}

TEST_P(LegacyFixture, IsSettledAfterOneRun) {
  const container::Container done = read(folder() / "upgraded" / GetParam());
  EXPECT_EQ(upgraded_bytes(done), done.bytes.text());
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  return info.param.substr(0, info.param.find('.'));
}

INSTANTIATE_TEST_SUITE_P(Upgrade, LegacyFixture, testing::ValuesIn(names()), test_name);

}  // namespace
}  // namespace gltfx::upgrade::test
