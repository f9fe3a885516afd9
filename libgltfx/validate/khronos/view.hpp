// SPDX-License-Identifier: Apache-2.0
/// The asset as the Khronos validator sees it: what it cannot read is absent, and what is not
/// whole it does not link.
#pragma once

#include "validate/context.hpp"
#include "validate/khronos/link_order.hpp"

namespace gltfx::validate {

/// Phase 3 and the references of phase 4 for that profile. Findings on form go to the schema sink;
/// broken references are left with `order`, for the rules to release. `document` is the context's
/// own; members that count as absent are hidden in it.
schema::CheckResult check_as_khronos(Context& context, json::Document& document, LinkOrder& order,
                                     const schema::ObjectVisitor& visitor);

}  // namespace gltfx::validate
