// SPDX-License-Identifier: Apache-2.0
/// The materials of a primitive in the variants of an asset (KHR_materials_variants).
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>

#include "rules/context.hpp"
#include "rules/extension_walk.hpp"

namespace gltfx::validate {

inline constexpr std::string_view kVariantsExtension = "KHR_materials_variants";

/// The `mappings` array of a primitive, or json::kNoNode if there is none or the extension is not
/// active.
json::NodeId variant_mappings(const Context& context, const ActiveExtensions& active,
                              json::NodeId primitive);

/// Reports a mapping in an asset without variants, with Deviations::root_extension_is_a_dependency.
/// True if there are variants.
bool check_variants_exist(const Context& context, json::NodeId mapping, const Path& path);

/// Variants of one primitive, with the index of the first mapping that contains them.
using SeenVariants = std::unordered_map<std::uint64_t, std::uint64_t>;

/// Reports the variants of one mapping that an earlier mapping also contains. `path` is that of the
/// mapping.
void check_unique_variants(const Context& context, json::NodeId mapping, std::uint64_t index,
                           const Path& path, SeenVariants& seen);

/// Calls `use(mapping, index, path)` for each mapping of the primitive at `path`.
template <typename Use>
void for_each_mapping(const Context& context, const ActiveExtensions& active,
                      json::NodeId primitive, const Path& path, Use use) {
  const json::NodeId mappings = variant_mappings(context, active, primitive);
  if (mappings == json::kNoNode) return;
  const Path extensions(path, "extensions");
  const Path object(extensions, kVariantsExtension);
  const Path array(object, "mappings");
  std::uint64_t index = 0;
  for (const json::NodeId mapping : context.document.elements(mappings)) {
    use(mapping, index, Path(array, index));
    ++index;
  }
}

}  // namespace gltfx::validate
