// SPDX-License-Identifier: Apache-2.0
/// Test cases made from a Set: for every object it describes the smallest valid one, and every way
/// to break it.
#pragma once

#include <string>
#include <vector>

#include "schema/case_values.hpp"

namespace gltfx::test {

/// A valid document with an object to vary.
struct Subject {
  std::string name;     ///< "material.KHR_materials_ior"
  Json document;        ///< a whole asset
  std::string pointer;  ///< of the object
  schema::ShapeId shape = schema::kNone;
  schema::ExtensionId extension =
      schema::kNone;  ///< whose object it is; kNone for inner and core ones
};

/// A document that has one error.
struct ErrorCase {
  std::string name;               ///< "material.KHR_materials_ior/ior: below"
  Json document;                  ///< with the error
  Json valid;                     ///< the same without it
  std::string object;             ///< pointer of the object
  std::string member;             ///< pointer of the member; equal to `object` when it is missing
  std::vector<std::string> says;  ///< texts that the finding's message must contain
};

/// What could not be made: "material.KHR_x/y: no valid value".
using Gaps = std::vector<std::string>;

class CaseGenerator {
 public:
  explicit CaseGenerator(const schema::Set& set) : set_(set), maker_(set) {}

  /// Each extension's object at each of its attachment points.
  std::vector<Subject> extension_subjects();
  /// The root and one element of each array of core.
  std::vector<Subject> core_subjects();
  /// Objects inside a subject's object: they are varied too.
  std::vector<Subject> inner_subjects(const Subject& subject);
  /// Every error of a subject's own members, its exclusions and companions.
  std::vector<ErrorCase> errors(const Subject& subject, Gaps& gaps);

  /// A valid asset that has two of everything.
  static Json base();
  /// Adds what made values refer to.
  void satisfy(Json& document, std::vector<Need> needs);
  /// Whether the schema has no finding on a document.
  bool is_clean(const Json& document) const;

 private:
  Json with_extension(const std::string& host, schema::ExtensionId id, schema::ShapeId shape);
  void add_extension(Json& document, const std::string& host, schema::ExtensionId id,
                     schema::ShapeId shape, std::vector<Need>& needs);
  void declare(Json& document, schema::ExtensionId id) const;
  std::string host_pointer(Json& document, const std::string& type);
  std::string pointer_from(Json& document, const std::string& start, schema::ShapeId top,
                           schema::TypeId wanted);
  void grow(Json& document, std::string pointer, schema::ShapeId shape,
            const std::vector<std::string>& steps, std::vector<Need>& needs);
  std::vector<ValueMaker::Around> around(const std::string& pointer) const;
  Json make_at(schema::ShapeId shape, const std::string& pointer, std::vector<Need>& needs);
  bool with_property(const Subject& subject, const schema::Property& property, Json& document);
  bool try_property(const Subject& subject, const schema::Property& property, Json start,
                    Json& document);
  void property_errors(const Subject& subject, const schema::Property& property,
                       std::vector<ErrorCase>& cases, Gaps& gaps);
  void object_errors(const Subject& subject, std::vector<ErrorCase>& cases);
  void extension_errors(const Subject& subject, std::vector<ErrorCase>& cases);

  const schema::Set& set_;
  ValueMaker maker_;
};

}  // namespace gltfx::test
