// SPDX-License-Identifier: Apache-2.0
// messages.txt: what every rule says about its own bad example, one line a rule, so that all
// messages are read together. After a wanted change of words run the test with
// GLTFX_UPDATE_GOLDEN=1 and read the difference before it is committed.
#include <gltfx/pipeline.hpp>
#include <gltfx/validate.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

namespace gltfx {
namespace {

// "CODE | severity | message | help", of the first finding of the rule.
std::string line(const RuleDescription& rule) {
  const FileReport report = validate_example(rule, Example::bad);
  const auto& all = report.diagnostics;
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Diagnostic& one) { return one.code == rule.code; });
  std::string text(rule.code);
  if (found == all.end()) return text += " | nothing found\n";
  text.append(" | ").append(severity_name(found->severity)).append(" | ").append(found->message);
  if (!found->help.empty()) text.append(" | ").append(found->help);
  return text += "\n";
}

TEST(Messages, AreAsWritten) {
  std::string text;
  for (const RuleDescription& rule : rules()) text += line(rule);
  const auto expected = std::filesystem::path(GLTFX_SOURCE_DIR) / "tests/golden/messages.txt";
  if (std::getenv("GLTFX_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(expected, std::ios::binary) << text;
  }
  std::ifstream in(expected, std::ios::binary);
  const std::string written{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  EXPECT_EQ(text, written) << "GLTFX_UPDATE_GOLDEN=1 rewrites " << expected;
}

}  // namespace
}  // namespace gltfx
