// SPDX-License-Identifier: Apache-2.0
/// Stores elements of accessors in new formats.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "base/result.hpp"
#include "steps/quantize_values.hpp"
#include "steps/step_data.hpp"

namespace gltfx::steps {

/// Accessors keep their index and get new elements, bounds and formats. Those of one kind and
/// format share a buffer view. All arguments must outlive it.
class FormatChanges {
 public:
  FormatChanges(const StepData& data, StepChanges& changes) : data_(data), changes_(changes) {}

  /// Elements of a vertex attribute. `kind`: accessors of different kinds have different views.
  void set(std::uint32_t accessor, unsigned kind, IntegerElements elements);
  /// Elements without alignment, such as matrices, in a view of their own.
  void set_plain(std::uint32_t accessor, std::string bytes);
  bool has(std::uint32_t accessor) const { return set_.contains(accessor); }
  bool empty() const { return set_.empty(); }

  /// Bytes that attributes save, minus an estimate of the text that they and nodes need.
  std::int64_t gain(std::uint64_t nodes) const;

  /// The index of a new accessor of numbers of single precision.
  std::uint64_t add_floats(model::ElementType type, std::string bytes);

  /// Call it once, before StepChanges::finish(). `outcome` gets what became of old buffer views.
  void store(StepOutcome& outcome);

 private:
  struct Change {
    std::optional<unsigned> kind;  ///< nothing: plain
    IntegerElements elements;
  };
  /// A place in a view of the pool.
  struct Stored {
    std::uint64_t view = 0;
    std::uint64_t offset = 0;
  };

  std::map<std::uint32_t, Stored> add_views(class ViewPool& pool);
  void declare(std::uint32_t accessor, const Change& change, std::uint64_t view,
               std::uint64_t offset);

  const StepData& data_;
  StepChanges& changes_;
  std::map<std::uint32_t, Change> set_;  ///< by accessor
};

}  // namespace gltfx::steps
