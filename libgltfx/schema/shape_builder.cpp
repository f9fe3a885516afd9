// SPDX-License-Identifier: Apache-2.0
#include "schema/shape_builder.hpp"

#include <algorithm>
#include <utility>

namespace gltfx::schema {
namespace {

constexpr std::size_t kLongestName = 1000;

// Bytes that a copy of a shape takes, roughly.
std::uint64_t copy_size(const Shape& shape) {
  std::uint64_t size = sizeof(Shape) + shape.title.size() + shape.description.size() +
                       shape.hint.size() + shape.zero_hint.size() + shape.format.size() +
                       shape.label.size();
  for (const Literal& literal : shape.literals) {
    size += sizeof(Literal) + literal.string.size() + literal.name.size();
  }
  for (const auto& [name, needed] : shape.dependent_required) {
    size += name.size();
    for (const std::string& other : needed) size += sizeof(std::string) + other.size();
  }
  const std::size_t ids = shape.all_of.size() + shape.any_of.size() + shape.one_of.size() +
                          shape.pattern_properties.size() + shape.conditions.size();
  return size + ids * sizeof(Condition);
}

// Keywords without a constraint on values.
bool is_annotation(Keyword keyword) {
  switch (keyword) {
    case Keyword::none:
    case Keyword::schema:
    case Keyword::id:
    case Keyword::ref:
    case Keyword::defs:
    case Keyword::comment:
    case Keyword::title:
    case Keyword::description:
    case Keyword::default_value:
    case Keyword::deprecated:
    case Keyword::examples:
    case Keyword::x_gltfx:
      return true;
    default:
      return false;
  }
}

}  // namespace

ShapeId ShapeBuilder::request(Site schema, const Where& where) {
  const Site real = behind_references(schema);
  if (!real.exists()) return kNone;
  const json::Document& document = build_.document(real);
  if (document.kind(real.node) == json::Kind::true_value) return kNone;
  if (document.kind(real.node) == json::Kind::false_value) return never_shape();
  const auto known = build_.shape_at.find(Build::key(real));
  if (known != build_.shape_at.end()) return known->second;
  return add(real, where);
}

ShapeId ShapeBuilder::add(Site schema, const Where& where) {
  if (where.type_name.size() > kLongestName || where.label.size() > kLongestName) {
    build_.errors.add(
        schema, "the path of this schema has more than " + std::to_string(kLongestName) + " bytes");
    return kNone;
  }
  const auto id = static_cast<ShapeId>(build_.set.shapes.size());
  build_.set.shapes.emplace_back().label = where.label;
  build_.shape_sites.push_back(schema);
  build_.shape_at.emplace(Build::key(schema), id);
  jobs_.push_back({id, schema, {}, where});
  return id;
}

ShapeId ShapeBuilder::never_shape() {
  if (never_ == kNone) {
    never_ = static_cast<ShapeId>(build_.set.shapes.size());
    build_.set.shapes.emplace_back().never = true;
    build_.shape_sites.push_back({});
  }
  return never_;
}

// `true` as one branch of several: combinators list shapes only.
ShapeId ShapeBuilder::any_shape() {
  if (any_ == kNone) {
    any_ = static_cast<ShapeId>(build_.set.shapes.size());
    build_.set.shapes.emplace_back();
    build_.shape_sites.push_back({});
  }
  return any_;
}

// Follows $refs that have only annotations beside them.
Site ShapeBuilder::behind_references(Site schema) {
  const Site start = schema;
  for (int steps = 0; schema.exists() && is_bare_reference(schema); ++steps) {
    if (steps == kLongestChain) {
      build_.errors.add(build_.member(start, "$ref"), "this $ref starts a chain of more than " +
                                                          std::to_string(kLongestChain) + " $refs");
      return {};
    }
    schema = build_.resolve(build_.member(schema, "$ref"));
  }
  return schema;
}

bool ShapeBuilder::is_bare_reference(Site schema) const {
  const json::Document& document = build_.document(schema);
  if (!build_.member(schema, "$ref").exists() || has_constraints(schema)) return false;
  const Site annotation = build_.member(schema, "x-gltfx");
  for (const std::string_view word :
       {"slot", "ref", "refHas", "refHolds", "refName", "openSince", "unitLength", "shouldMatch",
        "mayRefer", "mayPoint", "essential", "byPosition"}) {
    if (document.find(annotation.node, word) != json::kNoNode) return false;
  }
  return true;
}

bool ShapeBuilder::has_constraints(Site schema) const {
  const Source& source = build_.sources[schema.source];
  for (const auto& member : source.document.members(schema.node)) {
    if (!is_annotation(source.keywords[member.key_id])) return true;
  }
  return false;
}

void ShapeBuilder::run() {
  while (!jobs_.empty()) {
    const Job job = std::move(jobs_.back());
    jobs_.pop_back();
    work(job);
  }
  resolve_derived();
}

void ShapeBuilder::work(const Job& job) {
  const Site reference = build_.member(job.schema, "$ref");
  if (reference.exists() && !job.base.exists()) return derive(job);
  Shape shape;
  shape.label = job.where.label;
  Members members;
  const Source& source = build_.sources[job.schema.source];
  for (const auto& member : source.document.members(job.schema.node)) {
    const Site value{job.schema.source, member.value};
    read_keyword(source.keywords[member.key_id], value, job.where, shape, members);
  }
  if (members.annotation.exists()) read_annotation(members.annotation, job.where, shape);
  if (!build_.member(job.schema, "if").exists()) shape.conditions.clear();
  finish_members(job.shape, job.schema, job.where, shape, members);
  build_.set.shapes[job.shape] = std::move(shape);
}

// A $ref with other keywords: a copy of its target, with these keywords; further constraints become
// a separate shape that must hold as well.
void ShapeBuilder::derive(const Job& job) {
  Job kept = job;
  kept.base = build_.resolve(build_.member(job.schema, "$ref"));
  if (!kept.base.exists()) return;
  const Where base_where{kept.where.type_name, kept.where.label, false};
  bases_.push_back(request(kept.base, base_where));
  Shape& shape = build_.set.shapes[job.shape];
  if (has_constraints(job.schema)) {
    const auto beside = static_cast<ShapeId>(build_.set.shapes.size());
    shape.all_of.push_back(beside);
    build_.set.shapes.emplace_back();
    build_.shape_sites.push_back(job.schema);
    Where where = job.where;
    where.branch = true;
    jobs_.push_back({beside, job.schema, job.schema, where});
  }
  derived_.push_back(std::move(kept));
}

void ShapeBuilder::resolve_derived() {
  std::unordered_map<ShapeId, std::size_t> waiting;
  for (std::size_t i = 0; i < derived_.size(); ++i) waiting.emplace(derived_[i].shape, i);
  for (std::size_t i = 0; i < derived_.size(); ++i) {
    // Bases that are derived themselves come first.
    std::vector<std::size_t> chain;
    std::size_t at = i;
    while (true) {
      const auto known = waiting.find(derived_[at].shape);
      if (known == waiting.end()) break;
      waiting.erase(known);
      chain.push_back(at);
      const auto base = waiting.find(bases_[at]);
      if (base == waiting.end()) {
        if (std::any_of(chain.begin(), chain.end(),
                        [&](std::size_t link) { return derived_[link].shape == bases_[at]; })) {
          build_.errors.add(build_.member(derived_[at].schema, "$ref"), "this $ref is circular");
          bases_[at] = kNone;
        }
        break;
      }
      at = base->second;
    }
    for (auto link = chain.rbegin(); link != chain.rend(); ++link) {
      const ShapeId base = bases_[*link];
      Shape& shape = build_.set.shapes[derived_[*link].shape];
      const std::vector<ShapeId> beside = std::exchange(shape.all_of, {});
      if (base != kNone && !build_.may_copy(copy_size(build_.set.shapes[base]),
                                            build_.member(derived_[*link].schema, "$ref"))) {
        return;
      }
      if (base != kNone) shape = build_.set.shapes[base];
      shape.all_of.insert(shape.all_of.end(), beside.begin(), beside.end());
      copy_base(derived_[*link]);
    }
  }
}

// The keywords beside a $ref override those of its target.
void ShapeBuilder::copy_base(const Job& job) {
  Shape& shape = build_.set.shapes[job.shape];
  shape.label = job.where.label;
  Members members;
  for (const std::string_view word : {"title", "description", "x-gltfx"}) {
    const Site value = build_.member(job.schema, word);
    if (value.exists()) read_keyword(keyword_of(word), value, job.where, shape, members);
  }
  if (members.annotation.exists()) read_annotation(members.annotation, job.where, shape);
}

void build_shapes(Build& build) {
  ShapeBuilder builder(build);
  for (SourceId id = 0; id < build.sources.size(); ++id) {
    const Source& source = build.sources[id];
    const std::string name(source.short_name());
    builder.request({id, source.document.root()}, {name, name, false});
    const json::NodeId defs = source.find(source.document.root(), "$defs");
    if (defs == json::kNoNode) continue;
    for (const auto& member : source.document.members(defs)) {
      const std::string full = name + "." + std::string(source.document.key(member.key_id));
      builder.request({id, member.value}, {full, full, false});
    }
  }
  builder.run();
}

}  // namespace gltfx::schema
