// SPDX-License-Identifier: Apache-2.0
// Documents with one error.
#include <algorithm>

#include "schema/case_generator.hpp"

namespace gltfx::test {
namespace {

using schema::kNone;
using schema::Shape;
using schema::ShapeId;
using Pointer = Json::json_pointer;

// The members that a branch requires, if it has no other constraint.
std::vector<std::string> required_only(const schema::Set& set, ShapeId id) {
  std::vector<std::string> names;
  if (id == kNone || set.shape(id).type == kNone) return names;
  for (const schema::Property& property : set.type(set.shape(id).type).properties) {
    if (!property.required || property.shape != kNone) return {};
    names.push_back(property.name);
  }
  return names;
}

// Whether a shape forbids a member.
bool is_forbidden(const schema::Set& set, ShapeId id, const std::string& name) {
  if (id == kNone) return false;
  const Shape& shape = set.shape(id);
  const std::vector<std::string> unwanted = required_only(set, shape.not_shape);
  if (unwanted.size() == 1 && unwanted.front() == name) return true;
  return std::any_of(shape.all_of.begin(), shape.all_of.end(),
                     [&](ShapeId inside) { return is_forbidden(set, inside, name); });
}

}  // namespace

void CaseGenerator::property_errors(const Subject& subject, const schema::Property& property,
                                    std::vector<ErrorCase>& cases, Gaps& gaps) {
  Json valid;
  const std::string member = subject.pointer + "/" + property.name;
  const bool never = property.shape != kNone && set_.shape(property.shape).never;
  if (never || is_forbidden(set_, subject.shape, property.name)) {
    std::vector<Need> needs;
    Json document = subject.document;
    document[Pointer(member)] = make_at(property.shape, member, needs);
    satisfy(document, std::move(needs));
    cases.push_back(
        {member + ": forbidden", document, subject.document, subject.pointer, member, {}});
    return;
  }
  if (!with_property(subject, property, valid)) {
    gaps.push_back(subject.name + "/" + property.name + ": no valid value");
    return;
  }
  const auto add = [&](const std::string& how, Json document, const std::string& at) {
    cases.push_back({subject.name + "/" + property.name + ": " + how,
                     std::move(document),
                     valid,
                     subject.pointer,
                     at,
                     {}});
  };
  const Json good = valid[Pointer(member)];
  for (const BadValue& bad : bad_values(set_, property.shape, good)) {
    Json document = valid;
    document[Pointer(member)] = bad.value;
    add(bad.how, std::move(document), member);
  }
  if (!property.required) return;
  Json document = valid;
  document[Pointer(subject.pointer)].erase(property.name);
  add("missing", std::move(document), subject.pointer);
}

void CaseGenerator::object_errors(const Subject& subject, std::vector<ErrorCase>& cases) {
  const Shape& shape = set_.shape(subject.shape);
  const auto add = [&](const std::string& how, Json document, const std::string& member) {
    cases.push_back({subject.name + ": " + how,
                     std::move(document),
                     subject.document,
                     subject.pointer,
                     member.empty() ? subject.pointer : subject.pointer + "/" + member,
                     {}});
  };
  const bool closed = shape.type != kNone && !set_.type(shape.type).open;
  if (closed) {
    Json document = subject.document;
    document[Pointer(subject.pointer)]["notAMember"] = 1;
    add("unknown member", std::move(document), "notAMember");
  }
  for (const auto* branches : {&shape.any_of, &shape.one_of}) {
    Json none = subject.document;
    Json all = subject.document;
    bool only_names = !branches->empty();
    for (const ShapeId branch : *branches) {
      const std::vector<std::string> names = required_only(set_, branch);
      only_names = only_names && !names.empty();
      std::vector<Need> needs;
      for (const std::string& name : names) {
        none[Pointer(subject.pointer)].erase(name);
        const schema::Property* property = set_.find_property(shape.type, name);
        if (property == nullptr || all[Pointer(subject.pointer)].contains(name)) continue;
        all[Pointer(subject.pointer)][name] =
            make_at(property->shape, subject.pointer + "/" + name, needs);
      }
      satisfy(all, std::move(needs));
    }
    if (!only_names) continue;
    add("none of the alternatives", std::move(none), "");
    if (branches == &shape.one_of) add("all of the alternatives", std::move(all), "");
  }
  for (const auto& [name, others] : shape.dependent_required) {
    const schema::Property* property = set_.find_property(shape.type, name);
    Json valid;
    if (property == nullptr || !with_property(subject, *property, valid)) continue;
    for (const std::string& other : others) {
      Json document = valid;
      document[Pointer(subject.pointer)].erase(other);
      add(name + " without " + other, std::move(document), name);
    }
  }
}

void CaseGenerator::extension_errors(const Subject& subject, std::vector<ErrorCase>& cases) {
  const schema::Extension& extension = set_.extensions()[subject.extension];
  const std::string host = subject.pointer.substr(0, subject.pointer.rfind("/extensions/"));
  const auto add = [&](const std::string& how, Json document, std::vector<std::string> says = {}) {
    cases.push_back({subject.name + ": " + how, std::move(document), subject.document, host,
                     subject.pointer, std::move(says)});
  };
  Json document = subject.document;
  document[Pointer(subject.pointer)] = 3;
  add("no object", std::move(document));

  document = subject.document;
  Json& used = document["extensionsUsed"];
  used.erase(std::find(used.begin(), used.end(), Json(extension.name)));
  add("not declared", std::move(document));

  document = subject.document;
  document["asset"]["extensions"][extension.name] = document[Pointer(subject.pointer)];
  const schema::ShapeId at_asset = extension.shape_on(set_.find_type("asset"));
  if (at_asset == kNone) {
    cases.push_back({subject.name + ": on the asset",
                     document,
                     subject.document,
                     "/asset",
                     "/asset/extensions/" + extension.name,
                     {}});
  }
  for (const schema::Relation& relation : extension.excludes) {
    document = subject.document;
    document[Pointer(host)]["extensions"][relation.extension] = Json::object();
    document["extensionsUsed"].push_back(relation.extension);
    add("beside " + relation.extension, document, {extension.name, relation.extension});
  }
  for (const schema::Relation& relation : extension.requires_) {
    document = subject.document;
    if (document[Pointer(host)]["extensions"].erase(relation.extension) == 0) continue;
    add("without " + relation.extension, document, {extension.name, relation.extension});
  }
  if (extension.must_be_required == schema::MustBeRequired::without_fallback &&
      !extension.fallback.empty()) {
    document = subject.document;
    document[Pointer(host)].erase(extension.fallback);
    document.erase("extensionsRequired");
    add("optional without fallback", document, {extension.name});
  }
}

}  // namespace gltfx::test
