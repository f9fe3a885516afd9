// SPDX-License-Identifier: Apache-2.0
/// The parts of a schema object that describe members, gathered before they are put together.
#pragma once

#include "schema/shape_builder.hpp"

namespace gltfx::schema {

struct ShapeBuilder::Members {
  Site properties, required, additional, annotation;
};

}  // namespace gltfx::schema
