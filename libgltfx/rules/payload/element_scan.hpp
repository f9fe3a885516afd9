// SPDX-License-Identifier: Apache-2.0
/// One pass over an accessor for all of its checks.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "model/accessor_data.hpp"
#include "rules/payload/element_check.hpp"
#include "rules/payload/evaluator.hpp"

namespace gltfx::validate {

/// Errors of one kind, and the first of them.
struct Tally {
  std::uint64_t count = 0;
  DataError first;
};

/// A declared bound of one component that differs from the actual one.
struct BoundError {
  unsigned component = 0;
  double declared = 0;
  double actual = 0;
  std::uint64_t outside = 0;  ///< elements outside the declared bound
};

/// The result of a check.
struct Outcome {
  std::array<Tally, kErrorKinds> errors;
  std::uint64_t degenerate = 0;  ///< number of triangles
  std::vector<BoundError> bounds;

  std::uint64_t total() const;
  bool clean() const { return total() == 0 && degenerate == 0 && bounds.empty(); }
};

/// Runs `checks` over all elements. A check that equals an earlier one gets its outcome.
std::vector<Outcome> scan(const model::AccessorData& data, const std::vector<Check>& checks);

/// Calls `use(check, error)` for every single error, in the order of the elements and, for one
/// element, of the checks.
void list_errors(const model::AccessorData& data, const std::vector<Check>& checks,
                 const std::function<void(const Check&, const DataError&)>& use);

}  // namespace gltfx::validate
