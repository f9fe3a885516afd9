// SPDX-License-Identifier: Apache-2.0
/// Files that are there instead of a missing one.
#pragma once

#include <string>
#include <string_view>

#include "container/resolve_error.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// What to do where `path`, as container::Uri::path has it, cannot be opened: names the file that
/// is near it, if there is one.
std::string missing_file_help(const Context& context, container::ResolveError error,
                              std::string_view path);

}  // namespace gltfx::validate
