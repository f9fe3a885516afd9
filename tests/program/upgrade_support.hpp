// SPDX-License-Identifier: Apache-2.0
/// A folder with legacy assets and `gltfx upgrade` in it.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {

inline const std::string kLegacy = R"({
  "asset": { "version": "2.0" },
  "extensionsUsed": ["KHR_materials_translucency"],
  "materials": [
    {
      "name": "leaf",
      "extensions": { "KHR_materials_translucency": { "translucencyFactor": 0.70 } }
    }
  ]
})";
inline const std::string kUpgraded = R"({
  "asset": { "version": "2.0" },
  "extensionsUsed": ["KHR_materials_diffuse_transmission"],
  "materials": [
    {
      "name": "leaf",
      "extensions": { "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 0.70 } }
    }
  ]
})";

class UpgradeTest : public testing::Test {
 protected:
  Outcome here(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "upgrade");
    return gltfx(std::move(arguments), {folder_.path().native(), {}, {}});
  }
  std::string content(const std::string& name) const {
    return read_file((folder_.path() / name).native());
  }
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      found.push_back(entry.path().filename());
    }
    std::sort(found.begin(), found.end());
    return found;
  }
  struct stat status(const std::string& name) const {
    struct stat status {};
    ::stat((folder_.path() / name).c_str(), &status);
    return status;
  }

  container::test::TempFolder folder_;
};

}  // namespace gltfx::program
