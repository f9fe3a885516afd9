// SPDX-License-Identifier: Apache-2.0
/// One primitive and the mesh that its bitstream holds.
#pragma once

#include <cstdint>
#include <string_view>

#include "codec/client.hpp"
#include "model/draco.hpp"
#include "model/mesh.hpp"
#include "validate/data/phases.hpp"

namespace gltfx::validate {

struct DracoPrimitive {
  std::uint32_t mesh = 0;
  std::uint32_t index = 0;  ///< in the mesh
  const model::Primitive* primitive = nullptr;
  model::DracoReference reference;
};

/// Calls `use` with the path of the primitive.
template <typename Use>
void with_primitive_path(const DracoPrimitive& primitive, Use&& use) {
  const Path root;
  const Path meshes(root, "meshes");
  const Path mesh(meshes, std::uint64_t{primitive.mesh});
  const Path primitives(mesh, "primitives");
  use(Path(primitives, std::uint64_t{primitive.index}));
}

/// Calls `use` with the path of the extension's object on the primitive.
template <typename Use>
void with_draco_path(const DracoPrimitive& primitive, std::string_view extension, Use&& use) {
  with_primitive_path(primitive, [&](const Path& path) {
    const Path extensions(path, "extensions");
    use(Path(extensions, extension));
  });
}

/// Compares a decoded mesh with the accessors of its primitive: ids, formats, counts, and what
/// indices can hold. Elements of accessors that match and have no other data go to `phase.decoded`.
void check_draco_primitive(DataPhase& phase, const DracoPrimitive& primitive,
                           std::string_view extension, const codec::DracoMesh& mesh);

}  // namespace gltfx::validate
