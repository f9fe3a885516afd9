// SPDX-License-Identifier: Apache-2.0
/// The bytes that the URI of a buffer or image names, for readers that need no more than a sentence
/// when there are none.
#pragma once

#include <string_view>

#include "base/result.hpp"
#include "container/bytes.hpp"
#include "container/resolver.hpp"

namespace gltfx::container {

/// Decodes a data URI or opens the file of a relative path inside of the resolver's root. The Error
/// is one sentence, with or without its full stop; `error` gets what the resolver says of a file.
Result<Bytes> fetch(const Resolver& resolver, std::string_view uri, ResolveError* error = nullptr);

}  // namespace gltfx::container
