// SPDX-License-Identifier: Apache-2.0
#include "rules/own/own_members.hpp"

#include <algorithm>
#include <filesystem>
#include <variant>

#include "json/parse.hpp"
#include "report/value_json.hpp"
#include "rules/own/own_measures.hpp"

namespace gltfx::validate {

using model::RootArray;

std::vector<std::string_view> own_members(const OwnScope& scope) {
  std::vector<std::string_view> names{"path", "stem"};
  const bool element = scope.place == OwnScope::Place::element;
  const bool primitive = scope.place == OwnScope::Place::primitive;
  const bool node = element && scope.array == RootArray::nodes;
  if (element || primitive) names.emplace_back("index");
  if (node || primitive) names.emplace_back("mesh");
  if (node) names.insert(names.end(), {"parent", "root"});
  return names;
}

OwnMembers::OwnMembers(const Context& context, const std::string& name,
                       const Measurements* measured)
    : context_(context),
      measured_(measured),
      path_(std::filesystem::path(name).lexically_normal().native()) {
  std::string_view file = path_;
  file.remove_prefix(std::min(file.find_last_of('/') + 1, file.size()));
  const std::size_t dot = file.rfind('.');
  stem_ = file.substr(0, dot == 0 ? file.size() : dot);
}

json::Document OwnMembers::document(const OwnScope& scope, const OwnSubject& subject) const {
  std::string text;
  json::Writer writer(text);
  writer.begin_object();
  writer.member("path", path_);
  writer.member("stem", stem_);
  if (subject.index) writer.member("index", std::uint64_t{*subject.index});
  if (subject.mesh) writer.member("mesh", name_of(RootArray::meshes, *subject.mesh));
  const bool element = scope.place == OwnScope::Place::element;
  if (element && scope.array == RootArray::nodes) write_node(writer, *subject.index);
  write_measures(writer, scope, subject);
  writer.end_object();
  return json::parse(text).document;
}

// The names of what the node belongs to: empty without a name, missing if there is none.
void OwnMembers::write_node(json::Writer& writer, std::size_t node) const {
  if (const auto mesh = context_.asset.index(context_.asset.elements(RootArray::nodes)[node],
                                             "mesh", RootArray::meshes)) {
    writer.member("mesh", name_of(RootArray::meshes, *mesh));
  }
  const auto index = static_cast<model::NodeIndex>(node);
  if (node >= context_.graph.size()) return;
  if (const auto parent = context_.graph.parent(index); parent != model::kNoNodeIndex) {
    writer.member("parent", name_of(RootArray::nodes, parent));
  }
  if (const auto root = context_.graph.root(index); root != model::kNoNodeIndex) {
    writer.member("root", name_of(RootArray::nodes, root));
  }
}

// The measures of the object that rules ask for, under their names.
void OwnMembers::write_measures(json::Writer& writer, const OwnScope& scope,
                                const OwnSubject& subject) const {
  const auto on = measure_scope_of(scope);
  if (measured_ == nullptr || !on) return;
  const std::size_t element = element_of(subject);
  for (const MeasureColumn& column : measured_->columns[static_cast<std::size_t>(*on)]) {
    if (element >= column.values.size()) continue;
    writer.key(column.measure->name);
    report::write_value(writer, column.values[element], report::Texts::whole);
  }
}

OwnMembers::Fault OwnMembers::fault(const OwnScope& scope, const OwnSubject& subject,
                                    std::span<const MeasureDescription* const> of) const {
  const auto on = measure_scope_of(scope);
  if (measured_ == nullptr || !on) return {};
  const std::size_t element = element_of(subject);
  for (const MeasureDescription* measure : of) {
    const MeasureColumn* column = measured_->find(*on, measure->name);
    if (column == nullptr || element >= column->values.size()) continue;
    const auto* missing = std::get_if<NotMeasured>(&column->values[element]);
    if (missing == nullptr) continue;
    const MeasureReason& reason = measured_->reasons[missing->reason];
    if (reason.fault) return {measure, reason.text};
  }
  return {};
}

std::size_t OwnMembers::element_of(const OwnSubject& subject) const {
  if (!subject.mesh) return subject.index.value_or(0);
  const auto& all = measured_->primitives;
  const auto first = std::lower_bound(
      all.begin(), all.end(), *subject.mesh,
      [](const MeasuredPrimitive& primitive, std::size_t mesh) { return primitive.mesh < mesh; });
  return static_cast<std::size_t>(first - all.begin()) + subject.index.value_or(0);
}

std::string OwnMembers::name_of(RootArray array, std::size_t index) const {
  const json::NodeId object = context_.asset.elements(array)[index];
  return object == json::kNoNode ? std::string() : context_.asset.name(object);
}

}  // namespace gltfx::validate
