// SPDX-License-Identifier: Apache-2.0
/// How much waste is worth a word, and findings about it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "rules/finding.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {

inline constexpr std::uint64_t kWorthBytes = 1024;

/// Whether the bytes are many, and a hundredth of those of all buffers.
inline bool is_worth(const DataPhase& phase, std::uint64_t bytes) {
  return bytes >= kWorthBytes && bytes >= phase.resources.buffer_bytes() / 100;
}

/// Reports an element of a root array, with what removes the waste.
inline void report_waste(const DataPhase& phase, model::RootArray array, std::size_t index,
                         Code code, std::string message, std::string_view help) {
  const Path root;
  const Path list(root, model::root_array_name(array));
  phase.sink.report(Path(list, std::uint64_t{index}),
                    finding_on(phase.context, phase.context.asset.elements(array)[index], code,
                               std::move(message), std::string(help)));
}

}  // namespace gltfx::validate
