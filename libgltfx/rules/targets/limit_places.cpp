// SPDX-License-Identifier: Apache-2.0
#include "rules/targets/limit_places.hpp"

#include <utility>

#include <fmt/format.h>

#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

using model::RootArray;

// Of primitives: the array of their meshes.
RootArray array_of(MeasureScope on) {
  switch (on) {
    case MeasureScope::scene:
      return RootArray::scenes;
    case MeasureScope::node:
      return RootArray::nodes;
    case MeasureScope::material:
      return RootArray::materials;
    case MeasureScope::image:
      return RootArray::images;
    case MeasureScope::skin:
      return RootArray::skins;
    case MeasureScope::animation:
      return RootArray::animations;
    default:
      return RootArray::meshes;
  }
}

// The array whose name is that of the measure: "materials".
std::optional<RootArray> array_named(std::string_view name) {
  for (std::size_t i = 0; i < model::kRootArrayCount; ++i) {
    const auto array = static_cast<RootArray>(i);
    if (model::root_array_name(array) == name) return array;
  }
  return std::nullopt;
}

void mark_value(const Context& context, json::NodeId value, Finding& finding) {
  if (value != json::kNoNode) finding.span = first_character(context.document, value);
}

}  // namespace

// The group of primitives without a material.
bool LimitPlaces::is_plain(MeasureScope on, std::size_t element) const {
  return on == MeasureScope::material && element >= context_.asset.count(RootArray::materials);
}

Measured LimitPlaces::measured(MeasureScope on, std::size_t element) const {
  if (is_plain(on, element)) return {"primitives without a material", true};
  return {measure_scope_name(on), false};
}

json::NodeId LimitPlaces::object(MeasureScope on, std::size_t element) const {
  if (on == MeasureScope::asset || is_plain(on, element)) return json::kNoNode;
  if (on == MeasureScope::primitive) {
    const MeasuredPrimitive& at = taken_.primitives[element];
    return context_.views.meshes[at.mesh].primitives[at.index].node;
  }
  return context_.asset.elements(array_of(on))[element];
}

std::string LimitPlaces::pointer(MeasureScope on, std::size_t element) const {
  if (on == MeasureScope::asset) return {};
  if (is_plain(on, element)) return "/meshes";
  if (on == MeasureScope::primitive) {
    const MeasuredPrimitive& at = taken_.primitives[element];
    return fmt::format("/meshes/{}/primitives/{}", at.mesh, at.index);
  }
  return fmt::format("/{}/{}", model::root_array_name(array_of(on)), element);
}

std::string LimitPlaces::name(MeasureScope on, std::size_t element) const {
  if (on == MeasureScope::primitive) {
    return name(MeasureScope::mesh, taken_.primitives[element].mesh);
  }
  const json::NodeId at = object(on, element);
  return at == json::kNoNode ? std::string() : context_.asset.name(at);
}

void LimitPlaces::report(const Limit& limit, std::size_t element, Finding finding,
                         Sink& sink) const {
  const Path root;
  if (limit.on == MeasureScope::asset) {
    return report_asset(*limit.measure, std::move(finding), sink);
  }
  const Path array(root, model::root_array_name(array_of(limit.on)));
  if (is_plain(limit.on, element)) {
    const Path meshes(root, model::root_array_name(RootArray::meshes));
    mark_value(context_, context_.document.find(context_.document.root(), "meshes"), finding);
    return sink.report(meshes, std::move(finding));
  }
  mark_value(context_, object(limit.on, element), finding);
  if (limit.on != MeasureScope::primitive) {
    return sink.report(Path(array, std::uint64_t{element}), std::move(finding));
  }
  const MeasuredPrimitive& at = taken_.primitives[element];
  const Path mesh(array, std::uint64_t{at.mesh});
  const Path primitives(mesh, "primitives");
  sink.report(Path(primitives, std::uint64_t{at.index}), std::move(finding));
}

void LimitPlaces::report_asset(const MeasureDescription& measure, Finding finding,
                               Sink& sink) const {
  const Path root;
  std::optional<RootArray> array;
  if (measure.first == MeasureScope::asset) {
    array = array_named(measure.name);
  } else {
    array = array_of(measure.first);
  }
  const json::NodeId list =
      array ? context_.document.find(context_.document.root(), model::root_array_name(*array))
            : json::kNoNode;
  if (list == json::kNoNode) {
    mark_value(context_, context_.document.root(), finding);
    return sink.report(root, std::move(finding));
  }
  const Path path(root, model::root_array_name(*array));
  if (measure.first == MeasureScope::scene && default_scene_) {
    mark_value(context_, object(MeasureScope::scene, *default_scene_), finding);
    return sink.report(Path(path, std::uint64_t{*default_scene_}), std::move(finding));
  }
  mark_value(context_, list, finding);
  sink.report(path, std::move(finding));
}

}  // namespace gltfx::validate
