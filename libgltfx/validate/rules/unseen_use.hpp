// SPDX-License-Identifier: Apache-2.0
/// What extensions without a schema may refer to.
#pragma once

#include <string_view>

#include "validate/context.hpp"

namespace gltfx::validate {

/// An extension with objects in the asset of which nothing is known here: any of their numbers may
/// be an index, so nothing can be called unused. Empty when there is none, and where
/// Deviations::unsupported_extensions_are_skipped.
std::string_view unseen_user(const Context& context);

}  // namespace gltfx::validate
