// SPDX-License-Identifier: Apache-2.0
#include "model/mesh.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace gltfx::model {
namespace {

constexpr std::array<std::string_view, kCoreSemanticCount> kPrefixes{
    "POSITION", "NORMAL", "TANGENT", "TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<std::uint64_t> parse_set(std::string_view digits) {
  if (digits.empty() || !std::all_of(digits.begin(), digits.end(), is_digit)) return std::nullopt;
  if (digits.size() > 1 && digits.front() == '0') return std::nullopt;
  std::uint64_t set = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), set);
  return result.ec == std::errc() ? set : UINT64_MAX;
}

constexpr std::array<std::string_view, 7> kModes{
    "POINTS", "LINES", "LINE_LOOP", "LINE_STRIP", "TRIANGLES", "TRIANGLE_STRIP", "TRIANGLE_FAN"};

std::vector<json::NodeId> objects(const json::Document& document, json::NodeId array) {
  std::vector<json::NodeId> found;
  if (array == json::kNoNode || document.kind(array) != json::Kind::array) return found;
  for (const json::NodeId element : document.elements(array)) {
    found.push_back(document.is_object(element) ? element : json::kNoNode);
  }
  return found;
}

// The elements of `targets`; none when one of them is empty or not an object.
std::vector<json::NodeId> whole_targets(const json::Document& document, json::NodeId array) {
  std::vector<json::NodeId> targets = objects(document, array);
  const bool broken = std::any_of(targets.begin(), targets.end(), [&](json::NodeId target) {
    return target == json::kNoNode || document.node(target).next == target + 1;
  });
  return broken ? std::vector<json::NodeId>() : targets;
}

// Whether `targets` exists and is not empty, but has no whole_targets().
bool is_broken(const json::Document& document, json::NodeId targets) {
  if (targets == json::kNoNode) return false;
  const bool is_empty = document.is_array(targets) && document.array_size(targets) == 0;
  return !is_empty && whole_targets(document, targets).empty();
}

std::optional<std::uint32_t> index_at(const Asset& asset, json::NodeId value, RootArray array) {
  const json::Document& document = asset.document();
  if (value == json::kNoNode || !document.is_number(value)) return std::nullopt;
  return asset.index(document.number(value).value, array);
}

}  // namespace

bool is_indexed(SemanticKind kind) {
  return kind == SemanticKind::texcoord || kind == SemanticKind::color ||
         kind == SemanticKind::joints || kind == SemanticKind::weights;
}

std::string_view semantic_prefix(SemanticKind kind) {
  const auto at = static_cast<std::size_t>(kind);
  return at < kPrefixes.size() ? kPrefixes[at] : std::string_view();
}

Semantic parse_semantic(std::string_view name) {
  if (name.starts_with('_')) return {SemanticKind::application, 0};
  for (std::size_t i = 0; i < kPrefixes.size(); ++i) {
    if (!name.starts_with(kPrefixes[i])) continue;
    const auto kind = static_cast<SemanticKind>(i);
    const std::string_view rest = name.substr(kPrefixes[i].size());
    if (!is_indexed(kind)) return {rest.empty() ? kind : SemanticKind::invalid, 0};
    const auto set = rest.starts_with('_') ? parse_set(rest.substr(1)) : std::nullopt;
    return set ? Semantic{kind, *set} : Semantic{};
  }
  return {semantic_extension(name).empty() ? SemanticKind::invalid : SemanticKind::extension, 0};
}

std::string_view semantic_extension(std::string_view name) {
  const std::size_t colon = name.find(':');
  if (colon == std::string_view::npos || colon + 1 == name.size()) return {};
  const std::string_view prefix = name.substr(0, colon);
  const std::size_t underscore = prefix.find('_');
  if (underscore == std::string_view::npos || underscore == 0) return {};
  return underscore + 1 < prefix.size() ? prefix : std::string_view();
}

bool matches_semantic(std::string_view pattern, std::string_view name) {
  if (!pattern.ends_with("_n")) return pattern == name;
  const std::string_view stem = pattern.substr(0, pattern.size() - 1);
  return name.starts_with(stem) && parse_set(name.substr(stem.size())).has_value();
}

std::string_view mode_name(Mode mode) { return kModes[static_cast<std::size_t>(mode)]; }

std::vector<Attribute> read_attributes(const Asset& asset, json::NodeId object) {
  std::vector<Attribute> attributes;
  const json::Document& document = asset.document();
  if (object == json::kNoNode || !document.is_object(object)) return attributes;
  attributes.reserve(document.object_size(object));
  for (const auto member : document.members(object)) {
    Attribute attribute;
    attribute.name = document.key(member.key_id);
    attribute.semantic = parse_semantic(attribute.name);
    attribute.value = member.value;
    if (document.is_number(member.value)) {
      attribute.accessor = asset.index(document.number(member.value).value, RootArray::accessors);
    }
    attributes.push_back(attribute);
  }
  return attributes;
}

const Attribute* Primitive::find(SemanticKind kind, std::uint64_t set) const {
  const auto at = std::find_if(attributes.begin(), attributes.end(), [&](const Attribute& each) {
    return each.semantic.kind == kind && each.semantic.set == set;
  });
  return at == attributes.end() ? nullptr : &*at;
}

// One pass over the members: large files have a million primitives.
Primitive read_primitive(const Asset& asset, json::NodeId object) {
  const json::Document& document = asset.document();
  Primitive primitive;
  primitive.node = object;
  json::NodeId mode = json::kNoNode;
  json::NodeId targets = json::kNoNode;
  if (object == json::kNoNode || !document.is_object(object)) return primitive;
  for (const auto member : document.members(object)) {
    const std::string_view name = document.key(member.key_id);
    if (name == "attributes") primitive.attributes_node = member.value;
    if (name == "indices") primitive.indices_node = member.value;
    if (name == "material") primitive.material_node = member.value;
    if (name == "targets") targets = member.value;
    if (name == "mode") mode = member.value;
  }
  if (primitive.attributes_node != json::kNoNode &&
      !document.is_object(primitive.attributes_node)) {
    primitive.attributes_node = json::kNoNode;
  }
  primitive.attributes = read_attributes(asset, primitive.attributes_node);
  primitive.targets = whole_targets(document, targets);
  primitive.targets_are_broken = primitive.targets.empty() && is_broken(document, targets);
  primitive.indices = index_at(asset, primitive.indices_node, RootArray::accessors);
  primitive.material = index_at(asset, primitive.material_node, RootArray::materials);
  if (mode == json::kNoNode) {
    if (document.has_value(object, "mode")) primitive.mode.reset();
  } else {
    const auto number = document.unsigned_integer(mode);
    const bool valid = number && *number < kModes.size();
    primitive.mode = valid ? std::optional(static_cast<Mode>(*number)) : std::nullopt;
  }
  return primitive;
}

std::vector<Mesh> read_meshes(const Asset& asset) {
  std::vector<Mesh> meshes(asset.count(RootArray::meshes));
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    meshes[i].node = asset.elements(RootArray::meshes)[i];
    const auto objects = primitives(asset.document(), meshes[i].node);
    meshes[i].primitives.reserve(objects.size());
    for (const json::NodeId object : objects) {
      meshes[i].primitives.push_back(read_primitive(asset, object));
      if (object == json::kNoNode) meshes[i].has_holes = true;
    }
  }
  return meshes;
}

std::vector<json::NodeId> primitives(const json::Document& document, json::NodeId mesh) {
  return objects(document, document.find(mesh, "primitives"));
}

std::vector<json::NodeId> morph_targets(const json::Document& document, json::NodeId primitive) {
  return whole_targets(document, document.find(primitive, "targets"));
}

bool has_broken_targets(const json::Document& document, json::NodeId primitive) {
  return is_broken(document, document.find(primitive, "targets"));
}

}  // namespace gltfx::model
