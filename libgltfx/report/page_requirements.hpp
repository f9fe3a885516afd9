// SPDX-License-Identifier: Apache-2.0
/// The requirements of an asset as the page lists them: one row for each limit, however many
/// elements it holds for.
#pragma once

#include <gltfx/report.hpp>

#include <vector>

#include "json/writer.hpp"

namespace gltfx::report {

/// Writes an array. `previous`: those of an earlier run on the asset, whose values are written
/// beside the new ones; may be empty.
void write_page_requirements(json::Writer& writer, const std::vector<Requirement>& requirements,
                             const std::vector<Requirement>& previous);

}  // namespace gltfx::report
