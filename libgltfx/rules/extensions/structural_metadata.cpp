// SPDX-License-Identifier: Apache-2.0
// EXT_structural_metadata: objects and primitives with metadata need a schema on the root object.
// Rules that need the schema, which may be another file, run with the data
// (rules/payload/metadata/).
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/payload/metadata/phase.hpp"

namespace gltfx::validate {
namespace {

void check_roots(const Context& context) {
  const auto check = [&](const ExtensionPlace& place, const Path& path) {
    check_root_extension(context, kMetadataExtension, place.object, path);
  };
  for (std::size_t i = 0; i < model::kRootArrayCount; ++i) {
    for_each_extension(context, static_cast<model::RootArray>(i), kMetadataExtension, check);
  }
  for_each_primitive_extension(context, kMetadataExtension, check);
}

}  // namespace

const RuleGroup& structural_metadata_rules() {
  static constexpr LinkRule kLinkRules[] = {check_roots};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
