// SPDX-License-Identifier: Apache-2.0
/// Reports uses of accessors and buffer views that conflict with their first use, as far as schemas
/// describe them.
#pragma once

#include <string_view>

#include "model/usage.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// An extension with objects in the asset that has no schema: any of its numbers may be an index,
/// so no object can be called unused. Empty if there is none, and with
/// Deviations::unsupported_extensions_are_skipped.
std::string_view unseen_user(const Context& context);

/// One use of buffer view `view` by the index at `place` in the text. Reports
/// BUFFER_VIEW_TARGET_MISSING for the first use, BUFFER_VIEW_TARGET_OVERRIDE for one of another
/// kind.
void report_view_use(const Context& context, std::uint32_t view, model::ViewUse kind,
                     json::NodeId place, const Path& path);

/// A file (glTF 2.1) in buffer view `view`, all of which it takes. Reports
/// BUFFER_VIEW_TARGET_OVERRIDE for a view with a target or with other data.
void report_file_use(const Context& context, std::uint32_t view, json::NodeId place,
                     const Path& path);

/// Accessor `accessor`, which no core member uses, in buffer view `view`, all of which an image or
/// a file takes (glTF 2.1). Reports BUFFER_VIEW_TARGET_OVERRIDE.
void report_part_of_whole(const Context& context, std::uint32_t accessor, std::uint32_t view,
                          std::string_view whole, const Path& path);

/// One use of accessor `accessor`, and thereby of its view. Reports ACCESSOR_USAGE_OVERRIDE and
/// what report_view_use() does.
void report_use(const Context& context, std::uint32_t accessor, model::AccessorUse kind,
                json::NodeId place, const Path& path);

/// The fix of rules about strides: `user` refers to an accessor or a view whose stride must be
/// removed.
bool remove_used_stride(Fixing& fixing, const Subject& user);

/// Likewise for indices, whose view also gets its target.
bool remove_index_stride(Fixing& fixing, const Subject& user);

}  // namespace gltfx::validate
