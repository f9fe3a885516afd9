// SPDX-License-Identifier: Apache-2.0
/// Creates findings for problems of data.
#pragma once

#include <cstdint>
#include <string_view>

#include "model/accessor_data.hpp"
#include "rules/payload/element_scan.hpp"

namespace gltfx::validate {

/// The accessor that was read.
struct ScanResult {
  const Context& context;
  const Schedule& schedule;
  unsigned components = 1;
  std::uint64_t count = 0;  ///< elements
  /// Component type of decoded elements; none for plain ones.
  model::ComponentType decoded = model::ComponentType::none;
  bool draco = false;  ///< the elements are decoded from a Draco bitstream
  /// The elements differ from the originals: values are quantized, and the encoder chose indices
  /// and their order.
  bool lossy = false;
};

/// The sentence that ends messages about data decoded by Draco.
inline constexpr std::string_view kAfterDraco =
    " This is the value after Draco decoding, which is lossy.";

/// One error, or `count` errors of which `error` is the first.
Finding describe(const ScanResult& scan_result, const Check& check, const DataError& error,
                 std::uint64_t count);
/// A declared bound that differs from the real one, and the number of elements outside it.
Finding describe_mismatch(const ScanResult& scan_result, const Check& check,
                          const BoundError& error);
Finding describe_outside(const ScanResult& scan_result, const Check& check,
                         const BoundError& error);
/// Triangles without area; `count` is their number.
Finding describe_degenerate(const ScanResult& scan_result, const Check& check, std::uint64_t count);

/// The span of number `position` of an array of numbers in the text.
Span element_span(const json::Document& document, json::NodeId array, std::uint64_t position);

/// A number in messages; infinities and NaN by name.
std::string value_text(double value);

}  // namespace gltfx::validate
