// SPDX-License-Identifier: Apache-2.0
// Any text as a configuration, in the form of gltfx.toml and in that of the Khronos validator. What
// is read can be asked for; an imported one is read back.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "config_file.hpp"
#include "config_import.hpp"
#include "path_pattern.hpp"

namespace {

using namespace gltfx;

void require(bool holds) {
  if (!holds) std::abort();
}

void check_values(const std::vector<tool::ConfigValue>& values, bool by_path) {
  std::uint32_t line = 0;
  for (const tool::ConfigValue& value : values) {
    require(!value.key.name.empty() && value.line >= line);
    require(value.key.by_path || !by_path);
    line = value.line;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  // Pages are text of their own: none is read.
  const auto resolve = [](const std::string&) { return std::string("/dev/null/none"); };
  const auto pages = std::make_shared<tool::OwnPages>();
  if (const auto config = tool::parse_config(text, "gltfx.toml", resolve, pages)) {
    check_values(config->values, false);
    for (const tool::ConfigOverride& part : config->overrides) {
      require(!part.paths.empty());
      check_values(part.values, true);
      for (const std::string& pattern : part.paths) {
        tool::fits_pattern(pattern, "a/b/c.gltf");
        tool::fits_pattern(pattern, pattern);
      }
    }
  } else {
    require(!config.error().message.empty());
  }
  if (const auto imported = tool::khronos_config_as_toml(text, "config.yaml")) {
    require(static_cast<bool>(tool::parse_config(imported->toml, "gltfx.toml", resolve, pages)));
  } else {
    require(!imported.error().message.empty());
  }
  return 0;
}
