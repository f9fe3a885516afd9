// SPDX-License-Identifier: Apache-2.0
#include "model/variants.hpp"

#include "model/fields.hpp"

namespace gltfx::model {
namespace {

constexpr std::string_view kVariants = "KHR_materials_variants";

bool lists(const json::Document& document, json::NodeId variants, std::uint32_t wanted) {
  if (variants == json::kNoNode || document.kind(variants) != json::Kind::number_array) {
    return false;
  }
  for (json::NumberCursor at(document, variants); at.valid(); at.advance()) {
    if (at.number().value == static_cast<double>(wanted)) return true;
  }
  return false;
}

// The elements of an array member that is not an array of plain numbers.
std::vector<json::NodeId> elements_of(const json::Document& document, json::NodeId object,
                                      std::string_view name) {
  std::vector<json::NodeId> elements;
  const json::NodeId array = document.find(object, name);
  if (array == json::kNoNode || document.kind(array) != json::Kind::array) return elements;
  for (const json::NodeId element : document.elements(array)) elements.push_back(element);
  return elements;
}

}  // namespace

std::vector<std::string> variant_names(const Asset& asset) {
  const json::Document& document = asset.document();
  const json::NodeId object = extension_object(document, document.root(), kVariants);
  std::vector<std::string> names;
  for (const json::NodeId variant : elements_of(document, object, "variants")) {
    names.push_back(string_member(document, variant, "name"));
  }
  return names;
}

std::optional<std::uint32_t> material_of(const Asset& asset, const Primitive& primitive,
                                         std::optional<std::uint32_t> variant) {
  if (!variant || primitive.node == json::kNoNode) return primitive.material;
  const json::Document& document = asset.document();
  const json::NodeId object = extension_object(document, primitive.node, kVariants);
  for (const json::NodeId mapping : elements_of(document, object, "mappings")) {
    if (!lists(document, document.find(mapping, "variants"), *variant)) continue;
    if (const auto material = asset.index(mapping, "material", RootArray::materials)) {
      return material;
    }
  }
  return primitive.material;
}

}  // namespace gltfx::model
