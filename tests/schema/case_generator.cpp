// SPDX-License-Identifier: Apache-2.0
#include "schema/case_generator.hpp"

#include <algorithm>
#include <set>

namespace gltfx::test {
namespace {

using schema::kNone;
using schema::ShapeId;
using Pointer = Json::json_pointer;

}  // namespace

std::vector<Subject> CaseGenerator::extension_subjects() {
  std::vector<Subject> subjects;
  for (schema::ExtensionId id = 0; id < set_.extensions().size(); ++id) {
    const schema::Extension& extension = set_.extensions()[id];
    for (const auto& [type, shape] : extension.attachment_points) {
      const std::string host = set_.type(type).name;
      Subject subject{host + "." + extension.name, with_extension(host, id, shape), {}, shape, id};
      subject.pointer = host_pointer(subject.document, host) + "/extensions/" + extension.name;
      subjects.push_back(std::move(subject));
    }
  }
  return subjects;
}

std::vector<Subject> CaseGenerator::core_subjects() {
  std::vector<Subject> subjects;
  for (schema::TypeId id = 0; id < set_.types().size(); ++id) {
    const schema::ObjectType& type = set_.type(id);
    const bool inner =
        set_.shape(type.shape).type != type.origin || type.name.find("/") != type.name.npos;
    if (type.extension != kNone || inner || set_.find_type(type.name) != type.origin) continue;
    Subject subject{type.name, base(), {}, type.shape, kNone};
    subject.pointer = host_pointer(subject.document, type.name);
    if (subject.pointer.rfind("no way", 0) != 0) subjects.push_back(std::move(subject));
  }
  return subjects;
}

// Depth first; a type is entered once on the way down, so that graphs of types end.
std::vector<Subject> CaseGenerator::inner_subjects(const Subject& subject) {
  std::vector<Subject> found;
  std::set<schema::TypeId> seen{set_.shape(subject.shape).type};
  std::vector<Subject> open{subject};
  while (!open.empty()) {
    const Subject outer = std::move(open.back());
    open.pop_back();
    const schema::TypeId type = set_.shape(outer.shape).type;
    if (type == kNone) continue;
    for (const schema::Property& property : set_.type(type).properties) {
      ShapeId shape = property.shape;
      Json document;
      if (shape == kNone || !with_property(outer, property, document)) continue;
      std::string pointer = outer.pointer + "/" + property.name;
      while (shape != kNone && set_.shape(shape).type == kNone) {
        const schema::Shape& container = set_.shape(shape);
        const Json& value = document[Pointer(pointer)];
        if (value.empty() || (!value.is_array() && !value.is_object())) break;
        shape = value.is_array() ? container.items : container.values;
        pointer += value.is_array() ? "/0" : "/" + value.begin().key();
      }
      if (shape == kNone || set_.shape(shape).type == kNone) continue;
      if (!seen.insert(set_.shape(shape).type).second) continue;
      found.push_back({outer.name + "/" + property.name, document, pointer, shape, kNone});
      open.push_back(found.back());
    }
  }
  return found;
}

// The subject with one more member and its companions.
bool CaseGenerator::with_property(const Subject& subject, const schema::Property& property,
                                  Json& document) {
  const Json& object = subject.document[Pointer(subject.pointer)];
  if (object.contains(property.name)) {
    document = subject.document;
    return true;
  }
  // In addition to the existing members, with only what it needs, or with another kind of the
  // object.
  if (try_property(subject, property, object, document)) return true;
  if (try_property(subject, property, Json::object(), document)) return true;
  if (!property.default_json.empty()) {
    Json start = object;
    start[property.name] = Json::parse(property.default_json);
    if (try_property(subject, property, start, document)) return true;
  }
  for (const schema::Property& kind : set_.type(set_.shape(subject.shape).type).properties) {
    if (!kind.required || kind.shape == kNone) continue;
    for (const schema::Literal& literal : set_.shape(kind.shape).literals) {
      Json start = Json::object({{kind.name, literal.string}});
      if (literal.kind == schema::Literal::Kind::string &&
          try_property(subject, property, start, document))
        return true;
    }
  }
  return false;
}

bool CaseGenerator::try_property(const Subject& subject, const schema::Property& property,
                                 Json start, Json& document) {
  document = subject.document;
  std::vector<Need> needs;
  maker_.stand_in(around(subject.pointer));
  if (!start.contains(property.name)) {
    start[property.name] =
        maker_.make(property.shape, subject.pointer + "/" + property.name, needs);
  }
  maker_.complete(subject.shape, start, subject.pointer, needs);
  document[Pointer(subject.pointer)] = start;
  satisfy(document, std::move(needs));
  return is_clean(document);
}

std::vector<ErrorCase> CaseGenerator::errors(const Subject& subject, Gaps& gaps) {
  std::vector<ErrorCase> cases;
  const schema::TypeId type = set_.shape(subject.shape).type;
  if (type != kNone) {
    for (const schema::Property& property : set_.type(type).properties) {
      property_errors(subject, property, cases, gaps);
    }
  }
  object_errors(subject, cases);
  if (subject.extension != kNone) extension_errors(subject, cases);
  return cases;
}

}  // namespace gltfx::test
