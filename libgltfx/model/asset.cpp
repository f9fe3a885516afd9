// SPDX-License-Identifier: Apache-2.0
#include "model/asset.hpp"

#include <algorithm>

#include "model/memory_budget.hpp"

namespace gltfx::model {
namespace {

// glTF 1.0 kept its objects in dictionaries and always had shaders; `asset` was optional.
bool looks_like_version_1(const json::Document& document) {
  static constexpr std::array<std::string_view, 3> kOld{"techniques", "programs", "shaders"};
  static constexpr std::array<std::string_view, 3> kArrays{"accessors", "buffers", "meshes"};
  const auto is_object = [&](std::string_view name) {
    const json::NodeId value = document.find(document.root(), name);
    return value != json::kNoNode && document.is_object(value);
  };
  return std::any_of(kOld.begin(), kOld.end(), is_object) &&
         std::any_of(kArrays.begin(), kArrays.end(), is_object);
}

constexpr std::array<std::string_view, kRootArrayCount> kNames{
    "accessors", "animations", "buffers",  "bufferViews", "cameras", "images",  "materials",
    "meshes",    "nodes",      "samplers", "scenes",      "skins",   "textures"};

std::vector<json::NodeId> collect(const json::Document& document, json::NodeId array) {
  if (array == json::kNoNode || !document.is_array(array)) return {};
  if (document.kind(array) == json::Kind::number_array) {
    return std::vector<json::NodeId>(document.array_size(array), json::kNoNode);
  }
  std::vector<json::NodeId> objects;
  objects.reserve(document.array_size(array));
  for (const json::NodeId element : document.elements(array)) {
    objects.push_back(document.is_object(element) ? element : json::kNoNode);
  }
  return objects;
}

}  // namespace

// Exporters of that time wrote a number or a string.
bool is_gltf_1(const json::Document& document) {
  const json::NodeId place = document.find(document.find(document.root(), "asset"), "version");
  if (place == json::kNoNode) return looks_like_version_1(document);
  if (document.is_string(place)) {
    const std::string version = document.string(place);
    return version == "1.0" || version == "1.1";
  }
  if (!document.is_number(place)) return false;
  const double number = document.number(place).value;
  return number >= 1 && number < 2;
}

std::string_view root_array_name(RootArray array) {
  return kNames[static_cast<std::size_t>(array)];
}

std::uint64_t root_objects(const json::Document& document) {
  std::uint64_t count = 0;
  for (const std::string_view name : kNames) {
    const json::NodeId array = document.find(document.root(), name);
    if (array != json::kNoNode && document.is_array(array)) count += document.array_size(array);
  }
  return count;
}

Asset::Asset(const json::Document& document, bool any_amount) : document_(&document) {
  if (document.empty()) return;
  if (!any_amount && root_objects(document) > most_root_objects(document.text().size())) return;
  for (std::size_t i = 0; i < kRootArrayCount; ++i) {
    elements_[i] = collect(document, document.find(document.root(), kNames[i]));
  }
}

std::optional<std::uint32_t> Asset::index(json::NodeId object, std::string_view member,
                                          RootArray array) const {
  const json::NodeId value = document_->find(object, member);
  if (value == json::kNoNode || !document_->is_number(value)) return std::nullopt;
  return index(document_->number(value).value, array);
}

std::optional<std::uint32_t> Asset::index(double value, RootArray array) const {
  const auto& objects = elements(array);
  if (!(value >= 0) || value >= static_cast<double>(objects.size())) return std::nullopt;
  const auto at = static_cast<std::uint32_t>(value);
  if (static_cast<double>(at) != value || objects[at] == json::kNoNode) return std::nullopt;
  return at;
}

std::string Asset::name(json::NodeId object) const {
  const json::NodeId value = document_->find(object, "name");
  if (value == json::kNoNode || !document_->is_string(value)) return {};
  return document_->string(value);
}

}  // namespace gltfx::model
