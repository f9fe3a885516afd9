// SPDX-License-Identifier: Apache-2.0
/// Whether a value fits a shape, without findings: for conditions and alternatives.
#pragma once

#include <unordered_map>

#include "schema/document_names.hpp"
#include "schema/value.hpp"

namespace gltfx::schema {

/// One document against one Set. Results for containers are cached, so that the work of one call is
/// bounded by the number of shapes times that of nodes; below `kDepth` levels everything holds.
class Holds {
 public:
  /// `names` are those of the document in the Set; all three must outlive this.
  Holds(const json::Document& document, const Set& set, DocumentNames& names)
      : values_(document), set_(set), names_(names) {}
  bool operator()(ShapeId shape, Value value) {
    if (known_.size() > kMostKnown) known_.clear();
    return holds(shape, value, 0);
  }

 private:
  // Results are shared by the calls for one value and its surroundings; more entries would only
  // exceed the processor's cache.
  static constexpr std::size_t kMostKnown = 1U << 12U;
  static constexpr int kDepth = 100;
  bool holds(ShapeId shape, Value value, int depth);
  bool check(const Shape& shape, Value value, int depth);
  bool combinators(const Shape& shape, Value value, int depth);
  bool number(const Shape& shape, Value value) const;
  bool text(const Shape& shape, Value value) const;
  bool array(const Shape& shape, json::NodeId node, int depth);
  bool object(const Shape& shape, json::NodeId node, int depth);
  bool members(const Shape& shape, json::NodeId node, int depth);
  bool other_member(const Shape& shape, std::string_view name, json::NodeId value, int depth);

  Values values_;
  const Set& set_;
  DocumentNames& names_;
  std::unordered_map<std::uint64_t, bool> known_;
};

/// Whether a number is a multiple of another, within the precision of doubles.
bool is_multiple(double number, double of);

}  // namespace gltfx::schema
