// SPDX-License-Identifier: Apache-2.0
/// Values of measures as JSON.
#pragma once

#include <gltfx/measure.hpp>

#include "json/writer.hpp"

namespace gltfx::report {

/// One value; null if there is none.
void write_measure_value(json::Writer& writer, const MeasureValue& value);

/// The members `measures` (by scope: an object for the asset, lists with an index for others) and
/// `unmeasured` (why values are null; those with one reason together).
void write_measurements(json::Writer& writer, const Measurements& measurements);

}  // namespace gltfx::report
