// SPDX-License-Identifier: Apache-2.0
/// Existing files with a name similar to a missing one.
#pragma once

#include <string>
#include <string_view>

#include "container/resolve_error.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// Help for a `path`, as in container::Uri::path, that cannot be opened: names the file with a
/// similar name, if there is one.
std::string missing_file_help(const Context& context, container::ResolveError error,
                              std::string_view path);

}  // namespace gltfx::validate
