// SPDX-License-Identifier: Apache-2.0
/// Reports as few bytes, to be kept and read back by the same build of the program.
#pragma once

#include <gltfx/report.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace gltfx::report {

/// All but where the file lies: path and position.
std::string pack(const FileReport& report);

/// Nothing when these are no bytes that pack() gives. `rules`: sorted by code, of static storage.
std::optional<FileReport> unpack(std::string_view bytes, std::span<const RuleDescription> rules);

}  // namespace gltfx::report
