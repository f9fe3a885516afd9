// SPDX-License-Identifier: Apache-2.0
/// An asset whose only buffer is made along with it, for tests of what reads data.
#pragma once

#include <memory>
#include <string>

#include "json/parse.hpp"
#include "model/draco.hpp"
#include "model/geometry.hpp"
#include "support/asset_builder.hpp"

namespace gltfx::test {

/// Collects accessors, each on its own buffer view.
class Accessors {
 public:
  /// The index of the new accessor. `more` is added to its object: `, "normalized": true`.
  int add(const std::string& type, int component, std::size_t count, const std::string& bytes,
          const std::string& more = {}) {
    return static_cast<int>(
        made_.accessor(type, component, count, bytes, AssetBuilder::members_of(more)));
  }
  /// An accessor that is written unchanged.
  int add_plain(const std::string& object) {
    return static_cast<int>(made_.add("accessors", AssetBuilder::Json::parse(object)));
  }
  int add_view(const std::string& bytes, const std::string& more = {}) {
    return static_cast<int>(made_.view(bytes, AssetBuilder::members_of(more)));
  }

  const std::string& bytes() const { return made_.bytes; }
  /// The text of the asset, with further `members` of its root.
  std::string text(const std::string& members, const std::string& uri = {}) const {
    return made_.text(uri, members);
  }

 private:
  AssetBuilder made_;
};

/// The parsed asset with its buffer.
class BytesAsset {
 public:
  /// `members`: other members of the root object.
  BytesAsset(const Accessors& accessors, const std::string& members) {
    document_ = json::parse(share_text(accessors.text(members))).document;
    asset_ = std::make_unique<model::Asset>(document_);
    views_ = model::Views(*asset_);
    resources_.buffers.emplace_back(container::Bytes::from_string(std::string(accessors.bytes())));
    draco_.add_all(*asset_, views_, resources_);
  }

  const model::Asset& asset() const { return *asset_; }
  const model::Views& views() const { return views_; }
  const model::ResourceData& resources() const { return resources_; }
  model::DracoMeshes& draco() { return draco_; }
  const model::Primitive& primitive() const { return views_.meshes[0].primitives[0]; }

  struct Read {
    model::GeometryError error = model::GeometryError::none;
    model::Geometry geometry;
  };
  /// The first primitive of the first mesh.
  Read read(const model::GeometryRequest& request = {}, std::uint64_t budget = 1U << 20U) const {
    const model::GeometrySource source{*asset_, views_, resources_, draco_};
    model::MemoryBudget left(budget);
    Read read;
    read.error = model::read_geometry(source, primitive(), request, left, read.geometry);
    return read;
  }

 private:
  json::Document document_;
  std::unique_ptr<model::Asset> asset_;
  model::Views views_;
  model::ResourceData resources_;
  model::DracoMeshes draco_;
};

/// A mesh of one primitive, as the member "meshes".
inline std::string one_mesh(const std::string& attributes, const std::string& more = {}) {
  return R"("meshes": [{"primitives": [{"attributes": {)" + attributes + "}" + more + "}]}]";
}

}  // namespace gltfx::test
