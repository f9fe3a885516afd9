// SPDX-License-Identifier: Apache-2.0
/// Converts assets for engines that are made up.
#pragma once

#include <gltfx/pipeline.hpp>

#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "made_asset.hpp"
#include "target/target_file.hpp"

namespace gltfx::test {

/// An engine with these outcomes: JSON, by feature.
inline TargetChoice engine(const std::string& features, const std::string& name = "engine") {
  auto read = target::read_target(fmt::format(
      R"({{"format": 1, "name": "{}", "title": "Engine", "source": "other:engine",
          "measured": "objects", "versions": [{{"version": "1.0"}}], "features": {{{}}}}})",
      name, features));
  EXPECT_TRUE(read) << (read ? "" : read.error().message);
  return {std::make_shared<const Target>(*std::move(read)), 0};
}

/// An engine that refuses these features, however an asset has them.
inline TargetChoice refuser(const std::vector<std::string>& features) {
  std::string outcomes;
  for (const std::string& feature : features) {
    outcomes += fmt::format(R"({}"{}": {{"used": "refused", "required": "refused"}})",
                            outcomes.empty() ? "" : ", ", feature);
  }
  return engine(outcomes);
}

class TargetConversion : public testing::Test {
 protected:
  /// Converts a GLB for an engine. Files beside it are in `folder_`.
  ConvertReport convert(const std::string& bytes, const TargetChoice& choice) {
    return convert(folder_.write("a.glb", bytes), choice);
  }
  ConvertReport convert(const std::filesystem::path& from, const TargetChoice& choice) {
    options_.output = out_.native();
    options_.targets.push_back(choice);
    return convert_file(from.native(), options_);
  }
  /// Expects success, and that the engine refuses nothing of the result.
  StoredAsset converted(const std::string& bytes, const TargetChoice& choice) {
    const ConvertReport report = convert(bytes, choice);
    EXPECT_TRUE(report.written) << report.error;
    EXPECT_TRUE(report.remaining.empty()) << report.remaining.front().message;
    ValidateOptions options;
    options.targets = {choice};
    options.select = {"TARGET_REFUSES", "TARGET_IGNORES"};
    EXPECT_EQ(validate_file(out_.native(), options).counts.at_least(Severity::info), 0U);
    return StoredAsset::at(out_);
  }
  StoredAsset converted(MadeAsset& asset, const std::vector<std::string>& refused) {
    return converted(asset.glb(), refuser(refused));
  }

  container::test::TempFolder folder_;
  const std::filesystem::path out_ = folder_.path() / "out" / "a.glb";
  ConvertOptions options_;
};

}  // namespace gltfx::test
