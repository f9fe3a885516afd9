// SPDX-License-Identifier: Apache-2.0
/// The answer of a comparison as one self-contained web page.
#pragma once

#include <gltfx/compare.hpp>

#include <cstdint>
#include <string>

#include "compare_print.hpp"

namespace gltfx::tool {

/// Calls: begin, pair for each pair in order, end. Each appends text to `out`. Text of assets is
/// only in blocks of JSON, which no browser takes for markup. A pair is shown before the next
/// one is read.
class ComparePageWriter {
 public:
  static void begin(const std::string& title, std::string& out);
  void pair(const CompareReport& report, std::string& out);
  static void end(const CompareSummary& summary, std::string& out);

 private:
  std::uint64_t pairs_ = 0;
};

}  // namespace gltfx::tool
