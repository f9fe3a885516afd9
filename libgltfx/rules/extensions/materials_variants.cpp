// SPDX-License-Identifier: Apache-2.0
// KHR_materials_variants: one material per variant. This file is about that one extension and names
// it.
#include "rules/extensions/materials_variants.hpp"

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/fields.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
json::NodeId variant_mappings(const Context& context, const ActiveExtensions& active,
                              json::NodeId primitive) {
  const json::NodeId object =
      model::extension_object(context.document, primitive, kVariantsExtension);
  if (object == json::kNoNode || !active.contains(kVariantsExtension)) return json::kNoNode;
  const json::NodeId mappings = context.document.find(object, "mappings");
  const bool usable =
      mappings != json::kNoNode && context.document.kind(mappings) == json::Kind::array;
  return usable ? mappings : json::kNoNode;
}

// Otherwise the index of the variant is reported.
bool check_variants_exist(const Context& context, json::NodeId mapping, const Path& path) {
  return !context.deviations.root_extension_is_a_dependency ||
         check_root_extension(context, kVariantsExtension, mapping, path);
}

// A repeat inside one mapping is a repeat in an array of unique elements, which the schema walk
// reports.
void check_unique_variants(const Context& context, json::NodeId mapping, std::uint64_t index,
                           const Path& path, SeenVariants& seen) {
  const json::Document& document = context.document;
  const json::NodeId variants = document.find(mapping, "variants");
  if (variants == json::kNoNode) return;
  const Path array(path, "variants");
  const auto check = [&](const json::Number& number, std::uint64_t element) {
    if (!number.is_integer() || number.value < 0) return;
    const auto variant = static_cast<std::uint64_t>(number.value);
    const auto [first, is_new] = seen.emplace(variant, index);
    const bool reported = first->second == index;
    if (!is_new && (!reported || context.deviations.consequences_are_reported)) {
      report_link(
          context, Path(array, element), number.span,
          Code::KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT,
          fmt::format("Variant {} already has a material in mapping {}.", variant, first->second));
    }
    report_references(context, number.span);
  };
  std::uint64_t element = 0;
  if (document.kind(variants) == json::Kind::number_array) {
    for (json::NumberCursor at(document, variants); at.valid(); at.advance()) {
      check(at.number(), element++);
    }
    return;
  }
  for (const json::NodeId value : document.elements(variants)) {
    if (document.is_number(value)) check(document.number(value), element);
    ++element;
  }
}

}  // namespace gltfx::validate
