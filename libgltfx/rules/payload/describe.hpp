// SPDX-License-Identifier: Apache-2.0
/// What was found in data, as findings.
#pragma once

#include <cstdint>
#include <string_view>

#include "model/accessor_data.hpp"
#include "rules/payload/scan.hpp"

namespace gltfx::validate {

/// The accessor that was looked into.
struct ScanResult {
  const Context& context;
  const Schedule& schedule;
  unsigned components = 1;
  std::uint64_t count = 0;  ///< elements
  /// Type of the components where they were decoded; none for plain ones.
  model::ComponentType decoded = model::ComponentType::none;
  bool draco = false;  ///< the elements come out of a Draco bitstream
  /// And are not those that went in: values were quantised, indices and their order are the
  /// encoder's.
  bool lossy = false;
};

/// The sentence that ends messages about what Draco has decoded.
inline constexpr std::string_view kAfterDraco =
    " This is the value after Draco decoding, which is lossy.";

/// One error, or `count` of them of which `error` is the first.
Finding describe(const ScanResult& scan_result, const Check& check, const DataError& error,
                 std::uint64_t count);
/// A declared bound that is not the real one, and how many elements lie beyond it.
Finding describe_mismatch(const ScanResult& scan_result, const Check& check,
                          const BoundError& error);
Finding describe_outside(const ScanResult& scan_result, const Check& check,
                         const BoundError& error);
/// Triangles without area; there are `count` of them.
Finding describe_degenerate(const ScanResult& scan_result, const Check& check, std::uint64_t count);

/// Number `position` of an array of numbers in the text.
Span element_span(const json::Document& document, json::NodeId array, std::uint64_t position);

/// A number as messages show it; infinities and what is no number by name.
std::string value_text(double value);

}  // namespace gltfx::validate
