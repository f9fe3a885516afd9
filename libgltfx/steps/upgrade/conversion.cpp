// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/conversion.hpp"

namespace gltfx::upgrade {

bool ConversionContext::is_pointed_at(std::string_view path) const {
  return run.is_pointed_at(host, split_path(path));
}

bool ConversionContext::is_own_pointed_at(std::string_view member) const {
  const std::vector<std::string> path{"extensions", extension.name, std::string(member)};
  return run.is_pointed_at(host, path);
}

void ConversionContext::drop(std::string_view name) const {
  const json::NodeId value = member(name);
  if (value != json::kNoNode) run.editor.remove(host.object, value - 1);
}

std::unique_ptr<Conversion> make_conversion(std::string_view name) {
  if (name == "root-translation") return make_root_translation();
  if (name == "scattering") return make_scattering();
  if (name == "specular-glossiness") return make_specular_glossiness();
  if (name == "xmp") return make_xmp();
  return nullptr;
}

}  // namespace gltfx::upgrade
