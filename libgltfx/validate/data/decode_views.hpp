// SPDX-License-Identifier: Apache-2.0
/// Buffer views that come compressed.
#pragma once

#include "model/resource_data.hpp"
#include "validate/context.hpp"

namespace gltfx::validate {

/// Decodes each stream of meshoptimizer once and reports what is wrong with it. Elements without a
/// plain copy go to `resources`, so that everything behind reads them as plain data; those that
/// have one are compared with it. Takes memory only for what its stream can hold, and for little
/// beyond a limit that grows with the streams. Several threads; findings in the order of the views.
/// Nothing where Deviations::unsupported_extensions_are_skipped.
void decode_views(const Context& context, model::ResourceData& resources, Sink& sink);

}  // namespace gltfx::validate
