// SPDX-License-Identifier: Apache-2.0
/// Compact reports, stored and read by the same build of the program.
#pragma once

#include <gltfx/report.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace gltfx::report {

/// All members except path and position; of external assets, with the path.
std::string pack(const FileReport& report);

/// Nothing when the bytes are not from pack(). `rules`: sorted by code, with codes
/// of static storage.
std::optional<FileReport> unpack(std::string_view bytes, std::span<const RuleDescription> rules);

}  // namespace gltfx::report
