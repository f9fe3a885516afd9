// SPDX-License-Identifier: Apache-2.0
/// Geometry in Draco bitstreams (KHR_draco_mesh_compression), decoded once for all users.
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
  std::uint32_t buffer_view = 0;  ///< index of an object
};
/// Nothing when the primitive has no such extension, or one without a buffer view.
std::optional<DracoReference> read_draco(const Asset& asset, const Primitive& primitive);

/// The id of an attribute of the primitive in a reference, or nothing.
std::optional<std::uint64_t> draco_id(const Asset& asset, const DracoReference& reference,
                                      std::string_view attribute);

/// The glTF format of such elements; not known() if there is none. Bitstreams do not say reliably
/// whether integers are normalized: encoders omit it.
Format format_of(const codec::DracoAttribute& attribute, bool normalized);

/// The attribute with that id, or null.
const codec::DracoAttribute* find_attribute(const codec::DracoMesh& mesh, std::uint64_t id);

/// The bitstreams of an asset, each decoded once, also if primitives share it.
class DracoMeshes {
 public:
  struct NotLookedAt {};
  using Decoded = std::variant<NotLookedAt, codec::DracoMesh, codec::DecodeError>;

  /// Adds a buffer view to decode; its bytes are looked up here.
  void add(const Asset& asset, const Views& views, const ResourceData& resources,
           std::uint32_t buffer_view);
  /// Adds all buffer views that primitives of the asset refer to.
  void add_all(const Asset& asset, const Views& views, const ResourceData& resources);

  /// Decodes all added buffer views, on up to `jobs` threads. Stops when payloads exceed limits of
  /// time and memory, or when results are far too large for their bytes; which ones are left out
  /// does not depend on the number of threads.
  void decode(codec::Client& client, unsigned jobs);

  /// The result of a buffer view; null when it was not added or has no bytes.
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
