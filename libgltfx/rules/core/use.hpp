// SPDX-License-Identifier: Apache-2.0
/// Reports uses of accessors and buffer views that do not go with their first use, as far as a
/// schema tells of them.
#pragma once

#include <string_view>

#include "model/usage.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// An extension with objects in the asset of which nothing is known here: any of their numbers may
/// be an index, so nothing can be called unused. Empty when there is none, and where
/// Deviations::unsupported_extensions_are_skipped.
std::string_view unseen_user(const Context& context);

/// One use of buffer view `view` by the index that stands at `place` in the text. Reports
/// BUFFER_VIEW_TARGET_MISSING for the first use, BUFFER_VIEW_TARGET_OVERRIDE for one of another
/// kind.
void report_view_use(const Context& context, std::uint32_t view, model::ViewUse kind,
                     json::NodeId place, const Path& path);

/// One use of accessor `accessor`, and thereby of its view. Reports ACCESSOR_USAGE_OVERRIDE and
/// what report_view_use() does.
void report_use(const Context& context, std::uint32_t accessor, model::AccessorUse kind,
                json::NodeId place, const Path& path);

/// The fix of rules about strides: `place` is the index that uses an accessor or a view whose
/// stride is too much.
bool remove_stride_at(Fixing& fixing, Span place);

/// The same for indices, whose view gets its target, too.
bool remove_index_stride(Fixing& fixing, Span place);

}  // namespace gltfx::validate
