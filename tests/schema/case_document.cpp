// SPDX-License-Identifier: Apache-2.0
// The documents around the objects under test.
#include <algorithm>
#include <deque>

#include "schema/case_generator.hpp"
#include "schema/findings.hpp"

namespace gltfx::test {
namespace {

using schema::kNone;
using schema::ShapeId;
using schema::TypeId;
using Pointer = Json::json_pointer;

constexpr const char* kBase = R"({
  "asset": {"version": "2.1"}, "extensionsUsed": ["ACME_other"], "extensionsRequired": ["ACME_other"],
  "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3"}, {"componentType": 5126, "count": 3, "type": "VEC3"}],
  "animations": [
    {"channels": [{"sampler": 0, "target": {"path": "scale"}}], "samplers": [{"input": 0, "output": 1}, {"input": 0, "output": 1}]},
    {"channels": [{"sampler": 0, "target": {"path": "scale"}}], "samplers": [{"input": 0, "output": 1}, {"input": 0, "output": 1}]}],
  "buffers": [{"byteLength": 64}, {"byteLength": 64}],
  "bufferViews": [{"byteLength": 64, "buffer": 0}, {"byteLength": 64, "buffer": 1}],
  "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}},
              {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "zfar": 2, "znear": 1}}],
  "images": [{"uri": "a.png"}, {"uri": "b.png"}], "materials": [{}, {}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}, {"primitives": [{"attributes": {"POSITION": 0}}]}],
  "nodes": [{}, {}], "samplers": [{}, {}], "scenes": [{}], "scene": 0, "skins": [{"joints": [0]}, {"joints": [0]}],
  "files": [{"uri": "a.gltf", "mimeType": "model/gltf+json"}, {"uri": "b.glb", "mimeType": "model/gltf-binary"}],
  "externalAssets": [{"file": 1}, {"file": 1}], "shapes": [{"type": "ACME_a"}, {"type": "ACME_b"}],
  "textures": [{"source": 0}, {"source": 1}]})";

// How to get from an object to some object of a type: members, "0" for an array's first element,
// "*" for a member of a map.
struct Route {
  ShapeId shape;
  std::vector<std::string> steps;
};

}  // namespace

Json CaseGenerator::base() {
  static const Json kParsed = Json::parse(kBase);
  return kParsed;
}

bool CaseGenerator::is_clean(const Json& document) const {
  const std::vector<Found> findings = find(document.dump(), schema::Deviations(), set_);
  return std::all_of(findings.begin(), findings.end(),
                     [](const Found& found) { return found.code == "PROPERTY_DRAFT"; });
}

// The typed objects on the way to a place.
std::vector<ValueMaker::Around> CaseGenerator::around(const std::string& pointer) const {
  std::vector<ValueMaker::Around> objects;
  ShapeId shape = set_.type(set_.find_type("glTF")).shape;
  std::size_t at = 0;
  while (shape != kNone) {
    const schema::Shape& here = set_.shape(shape);
    if (here.type != kNone) objects.push_back({set_.type(here.type).origin, pointer.substr(0, at)});
    if (at >= pointer.size()) break;
    const auto next = [&] {
      const std::size_t start = at + 1;
      at = std::min(pointer.find('/', start), pointer.size());
      return pointer.substr(start, at - start);
    };
    const std::string step = next();
    if (step == "extensions") {
      if (at >= pointer.size()) break;
      const std::string name = next();
      shape = set_.extensions()[set_.find_extension(name)].shape_on(here.type);
    } else if (const schema::Property* property = set_.find_property(here.type, step)) {
      shape = property->shape;
    } else {
      shape = here.items != kNone ? here.items : here.values;
    }
  }
  return objects;
}

Json CaseGenerator::make_at(ShapeId shape, const std::string& pointer, std::vector<Need>& needs) {
  maker_.stand_in(around(pointer.substr(0, pointer.rfind('/'))));
  return maker_.make(shape, pointer, needs);
}

void CaseGenerator::declare(Json& document, schema::ExtensionId id) const {
  const schema::Extension& extension = set_.extensions()[id];
  const auto add = [&](const char* list) {
    Json& names = document[list];
    if (names.is_null()) names = Json::array();
    if (std::find(names.begin(), names.end(), Json(extension.name)) == names.end())
      names.push_back(extension.name);
  };
  add("extensionsUsed");
  if (extension.must_be_required != schema::MustBeRequired::optional) add("extensionsRequired");
}

// An object of an extension on that of another type.
std::string CaseGenerator::host_pointer(Json& document, const std::string& type) {
  const TypeId wanted = set_.find_type(type);
  const schema::ExtensionId id = set_.type(wanted).extension;
  if (id == kNone)
    return pointer_from(document, {}, set_.type(set_.find_type("glTF")).shape, wanted);
  const schema::Extension& extension = set_.extensions()[id];
  for (const auto& [home, shape] : extension.attachment_points) {
    Json grown = document;
    std::string pointer = host_pointer(grown, set_.type(home).name);
    std::vector<Need> needs;
    add_extension(grown, pointer, id, shape, needs);
    satisfy(grown, std::move(needs));
    pointer = pointer_from(grown, pointer + "/extensions/" + extension.name, shape, wanted);
    if (pointer.rfind("no way", 0) == 0) continue;
    document = std::move(grown);
    return pointer;
  }
  return "no way to " + type;
}

// Breadth first through the types below an object.
std::string CaseGenerator::pointer_from(Json& document, const std::string& start, ShapeId top,
                                        TypeId wanted) {
  std::deque<Route> routes{{top, {}}};
  for (std::size_t tries = 0; !routes.empty() && tries < 5000; ++tries) {
    const Route route = routes.front();
    routes.pop_front();
    const schema::Shape& shape = set_.shape(route.shape);
    if (shape.type == wanted) {
      std::string pointer = start;
      std::vector<Need> needs;
      ShapeId at = top;
      for (std::size_t i = 0; i < route.steps.size(); ++i) {
        const std::string& step = route.steps[i];
        Json& here = document[Pointer(pointer)];
        if (step == "*") {
          at = set_.shape(at).values;
          pointer += "/" + (here.empty() ? std::string("a") : here.begin().key());
          if (here.empty()) {
            Json made = make_at(at, pointer, needs);
            document[Pointer(pointer)] = std::move(made);
          }
          continue;
        }
        const bool element = step == "0";
        at = element ? set_.shape(at).items : set_.find_property(set_.shape(at).type, step)->shape;
        // Of the elements the one that has the next member is the one that may have it.
        const bool second = element && here.size() > 1 && i + 1 < route.steps.size() &&
                            here[1].contains(route.steps[i + 1]) &&
                            !here[0].contains(route.steps[i + 1]);
        pointer += second ? "/1" : "/" + step;
        if (!element && !here.contains(step)) {
          Json made = make_at(at, pointer, needs);
          document[Pointer(pointer)] = std::move(made);
        }
      }
      satisfy(document, std::move(needs));
      return pointer;
    }
    const auto go = [&](const std::string& step, ShapeId next) {
      if (next == kNone || route.steps.size() > 8) return;
      routes.push_back({next, route.steps});
      routes.back().steps.push_back(step);
    };
    go("0", shape.items);
    go("*", shape.values);
    if (shape.type == kNone) continue;
    for (const schema::Property& property : set_.type(shape.type).properties)
      go(property.name, property.shape);
  }
  return "no way to " + set_.type(wanted).name;
}

void CaseGenerator::add_extension(Json& document, const std::string& host, schema::ExtensionId id,
                                  ShapeId shape, std::vector<Need>& needs) {
  const schema::Extension& extension = set_.extensions()[id];
  declare(document, id);
  Json& object = document[Pointer(host)];
  if (object.contains("extensions") && object["extensions"].contains(extension.name)) return;
  object["extensions"][extension.name] =
      make_at(shape, host + "/extensions/" + extension.name, needs);
  const auto home =
      std::find_if(extension.attachment_points.begin(), extension.attachment_points.end(),
                   [shape](const auto& entry) { return entry.second == shape; });
  for (const schema::Relation& relation : extension.requires_) {
    const schema::ExtensionId other = set_.find_extension(relation.extension);
    const ShapeId other_shape =
        other == kNone ? kNone : set_.extensions()[other].shape_on(home->first);
    if (other_shape != kNone) add_extension(document, host, other, other_shape, needs);
  }
}

// Makes each thing that is needed; that may need further things.
void CaseGenerator::satisfy(Json& document, std::vector<Need> needs) {
  for (std::size_t i = 0; i < needs.size() && i < 200; ++i) {
    const Need need = needs[i];
    std::string pointer = need.from;
    TypeId type = need.target.base == schema::Target::Base::enclosing ? need.target.enclosing
                                                                      : set_.find_type("glTF");
    ShapeId shape = set_.type(type).shape;
    for (std::size_t s = 0; s < need.target.steps.size(); ++s) {
      const std::string& step = need.target.steps[s];
      if (step == "extensions") {
        const schema::ExtensionId id = set_.find_extension(need.target.steps[++s]);
        shape = set_.extensions()[id].shape_on(set_.shape(shape).type);
        add_extension(document, pointer, id, shape, needs);
        pointer += "/extensions/" + need.target.steps[s];
        continue;
      }
      const bool element = step == "*";
      shape = element ? set_.shape(shape).items
                      : set_.find_property(set_.shape(shape).type, step)->shape;
      Json& here = document[Pointer(pointer)];
      pointer += element ? "/0" : "/" + step;
      if (element ? here.empty() : !here.contains(step)) {
        Json made = make_at(shape, pointer, needs);
        Json& now = document[Pointer(pointer.substr(0, pointer.rfind('/')))];
        if (element) {
          now.push_back(std::move(made));
        } else {
          now[step] = std::move(made);
        }
      }
    }
    if (need.is_name) {
      const Json place = document[Pointer(pointer)];
      document[Pointer(need.at)] = place.is_object() ? Json(place.begin().key()) : place;
    }
    if (!need.has.empty()) grow(document, pointer + "/0", set_.shape(shape).items, need.has, needs);
  }
}

// Members that an object must have because of a reference to it.
void CaseGenerator::grow(Json& document, std::string pointer, ShapeId shape,
                         const std::vector<std::string>& steps, std::vector<Need>& needs) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i] == "extensions") {
      const schema::ExtensionId id = set_.find_extension(steps[++i]);
      shape = set_.extensions()[id].shape_on(set_.shape(shape).type);
      add_extension(document, pointer, id, shape, needs);
      pointer += "/extensions/" + steps[i];
      continue;
    }
    shape = set_.find_property(set_.shape(shape).type, steps[i])->shape;
    pointer += "/" + steps[i];
    if (document.contains(Pointer(pointer))) continue;
    Json made = make_at(shape, pointer, needs);
    document[Pointer(pointer)] = std::move(made);
  }
}

Json CaseGenerator::with_extension(const std::string& host, schema::ExtensionId id, ShapeId shape) {
  Json document = base();
  const std::string pointer = host_pointer(document, host);
  std::vector<Need> needs;
  add_extension(document, pointer, id, shape, needs);
  satisfy(document, std::move(needs));
  return document;
}

}  // namespace gltfx::test
