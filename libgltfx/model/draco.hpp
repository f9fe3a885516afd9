// SPDX-License-Identifier: Apache-2.0
/// Geometry that comes as a bitstream of Draco (KHR_draco_mesh_compression), decoded for everybody
/// who needs it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "codec/client.hpp"
#include "model/accessor.hpp"
#include "model/mesh.hpp"
#include "model/resource_data.hpp"
#include "model/views.hpp"

namespace gltfx::model {

inline constexpr std::string_view kDracoExtension = "KHR_draco_mesh_compression";

/// The extension on a primitive.
struct DracoReference {
  json::NodeId object = json::kNoNode;
  std::uint32_t buffer_view = 0;  ///< leads to an object
};
/// Nothing when the primitive has no such extension, or one without a buffer view.
std::optional<DracoReference> read_draco(const Asset& asset, const Primitive& primitive);

/// The id by which a reference knows an attribute of the primitive, or nothing.
std::optional<std::uint64_t> draco_id(const Asset& asset, const DracoReference& reference,
                                      std::string_view attribute);

/// What glTF calls such elements; not known() where it has no such type. Bitstreams do not say
/// reliably whether integers are normalized: encoders leave that out.
Format format_of(const codec::DracoAttribute& attribute, bool normalized);

/// The attribute with that id, or null.
const codec::DracoAttribute* find_attribute(const codec::DracoMesh& mesh, std::uint64_t id);

/// The bitstreams of an asset, each decoded once however many primitives share it.
class DracoMeshes {
 public:
  struct NotLookedAt {};
  using Decoded = std::variant<NotLookedAt, codec::DracoMesh, codec::DecodeError>;

  /// Notes a buffer view to decode; its bytes are looked up here.
  void add(const Asset& asset, const Views& views, const ResourceData& resources,
           std::uint32_t buffer_view);
  /// Notes all that primitives of the asset refer to.
  void add_all(const Asset& asset, const Views& views, const ResourceData& resources);

  /// Decodes all that were noted, on up to `jobs` threads. Stops where payloads run into limits of
  /// time and memory, or where results are far larger than their bytes can be worth; which ones are
  /// left over does not depend on the number of threads.
  void decode(codec::Client& client, unsigned jobs);

  /// What became of a buffer view; null when it was not noted or has no bytes.
  const Decoded* find(std::uint32_t buffer_view) const;
  /// The mesh, or null.
  const codec::DracoMesh* mesh(std::uint32_t buffer_view) const;

 private:
  struct Payload {
    container::Bytes bytes;
    Origin origin;
    Decoded decoded;
  };

  std::vector<Payload> payloads_;
  std::unordered_map<std::uint32_t, std::size_t> positions_;  // in payloads_, by buffer view
};

}  // namespace gltfx::model
