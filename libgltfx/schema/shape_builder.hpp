// SPDX-License-Identifier: Apache-2.0
/// Makes shapes and object types from schema objects.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "schema/build.hpp"

namespace gltfx::schema {

/// Works through a list, so that neither nesting nor `$ref`s are followed on the call stack.
class ShapeBuilder {
 public:
  explicit ShapeBuilder(Build& build) : build_(build) {}

  /// The name of the result of a schema, and whether it is a branch of a combinator, in which
  /// `properties` do not make other members unknown.
  struct Where {
    std::string type_name;
    std::string label;
    bool branch = false;
  };

  /// The shape of a schema, made by run(). kNone for schemas that accept everything.
  ShapeId request(Site schema, const Where& where);
  void run();

 private:
  struct Job {
    ShapeId shape;
    Site schema;
    Site base;  ///< target of a `$ref` with other keywords
    Where where;
  };
  struct Members;

  ShapeId add(Site schema, const Where& where);
  ShapeId never_shape();
  ShapeId any_shape();
  Site behind_references(Site schema);
  bool is_bare_reference(Site schema) const;
  bool has_constraints(Site schema) const;
  void work(const Job& job);
  void derive(const Job& job);
  void resolve_derived();
  void copy_base(const Job& job);
  void read_keyword(Keyword keyword, Site value, const Where& where, Shape& shape,
                    Members& members);
  void read_scalar(Keyword keyword, Site value, Shape& shape);
  void read_branches(Keyword keyword, Site value, const Where& where, Shape& shape);
  void read_annotation(Site annotation, const Where& where, Shape& shape);
  void finish_members(ShapeId id, Site schema, const Where& where, Shape& shape,
                      const Members& members);
  std::vector<Property> read_properties(const Members& members, const Where& where);
  void read_versions(Site annotation, const Where& where, Property& property);
  Property read_property(Site schema, std::string_view name, const Where& where);
  std::uint32_t pattern(std::string_view expression);
  void report_misspelt_required(const Members& members, const ObjectType& type);

  Build& build_;
  std::vector<Job> jobs_;
  std::vector<Job> derived_;
  std::vector<ShapeId> bases_;  ///< by position in derived_
  std::unordered_map<std::string, std::uint32_t> patterns_;
  ShapeId never_ = kNone;
  ShapeId any_ = kNone;
};

/// Parts of the annotation `x-gltfx` that both shapes and extensions read.
Slot read_slot(const Build& build, Site slot);
/// The steps of "a/b/c".
std::vector<std::string> split_steps(std::string_view text);
Target read_target(const Build& build, Site text);
Upgrade read_upgrade(const Build& build, Site upgrade);
Version read_version(const Build& build, Site text);
std::vector<std::string> read_names(const Build& build, Site list);
Literal read_literal(const json::Document& document, json::NodeId node);
std::vector<Literal> read_literals(const Build& build, Site list);

struct ShapeBuilder::Members {
  Site properties, required, additional, annotation;
};

}  // namespace gltfx::schema
