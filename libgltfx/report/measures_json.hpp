// SPDX-License-Identifier: Apache-2.0
/// The measures of an asset as JSON.
#pragma once

#include <gltfx/measure.hpp>

#include "json/writer.hpp"

namespace gltfx::report {

/// The members `measures` (by scope: an object for the asset, lists with an index for others) and
/// `unmeasured` (why values are null; those with one reason together).
void write_measurements(json::Writer& writer, const Measurements& measurements);

}  // namespace gltfx::report
