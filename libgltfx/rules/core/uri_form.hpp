// SPDX-License-Identifier: Apache-2.0
/// The form of URIs of all objects.
#pragma once

#include "rules/context.hpp"

namespace gltfx::validate {

/// Reports problems of the string `value` as a reference to a file. Data URIs have none.
void check_uri_form(const Context& context, Sink& sink, json::NodeId value, const Path& path);

}  // namespace gltfx::validate
