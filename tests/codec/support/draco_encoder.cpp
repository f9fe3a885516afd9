// SPDX-License-Identifier: Apache-2.0
#include "draco_encoder.hpp"

#include <cstring>

#include <draco/compression/expert_encode.h>

#include "model/packed_bytes.hpp"

namespace gltfx::test {
namespace {

using Attribute = DracoSource::Attribute;

draco::GeometryAttribute::Type kind_of(DracoSource::Kind kind) {
  static constexpr draco::GeometryAttribute::Type kKinds[] = {
      draco::GeometryAttribute::POSITION, draco::GeometryAttribute::NORMAL,
      draco::GeometryAttribute::COLOR, draco::GeometryAttribute::TEX_COORD,
      draco::GeometryAttribute::GENERIC};
  return kKinds[static_cast<std::size_t>(kind)];
}

draco::DataType type_of(DracoSource::Type type) {
  static constexpr draco::DataType kTypes[] = {
      draco::DT_INT8,   draco::DT_UINT8,   draco::DT_INT16,  draco::DT_UINT16,
      draco::DT_UINT32, draco::DT_FLOAT32, draco::DT_FLOAT64};
  return kTypes[static_cast<std::size_t>(type)];
}

void add_attribute(draco::PointCloud& cloud, const Attribute& attribute) {
  const draco::DataType type = type_of(attribute.type);
  const std::int64_t size = draco::DataTypeLength(type) * static_cast<int>(attribute.components);
  draco::GeometryAttribute description;
  description.Init(kind_of(attribute.kind), nullptr,
                   static_cast<std::uint8_t>(attribute.components), type, attribute.normalized,
                   size, 0);
  const int index = cloud.AddAttribute(description, true, cloud.num_points());
  draco::PointAttribute* added = cloud.attribute(index);
  for (std::uint32_t i = 0; i < cloud.num_points(); ++i) {
    added->SetAttributeValue(draco::AttributeValueIndex(i),
                             attribute.bytes.data() + i * static_cast<std::size_t>(size));
  }
  added->set_unique_id(attribute.id);
}

void fill(draco::PointCloud& cloud, const DracoSource& source) {
  cloud.set_num_points(source.points);
  for (const Attribute& attribute : source.attributes) add_attribute(cloud, attribute);
}

std::string encode(draco::ExpertEncoder& encoder, const DracoSource& source, int method) {
  encoder.SetEncodingMethod(method);
  for (std::size_t i = 0; i < source.attributes.size(); ++i) {
    if (source.attributes[i].bits == 0) continue;
    encoder.SetAttributeQuantization(static_cast<int>(i), source.attributes[i].bits);
  }
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok()) return {};
  return {buffer.data(), buffer.size()};
}

}  // namespace

std::string draco_bytes(const DracoSource& source) {
  draco::Mesh mesh;
  fill(mesh, source);
  for (std::size_t i = 0; i + 2 < source.indices.size(); i += 3) {
    mesh.AddFace({draco::PointIndex(source.indices[i]), draco::PointIndex(source.indices[i + 1]),
                  draco::PointIndex(source.indices[i + 2])});
  }
  draco::ExpertEncoder encoder(mesh);
  return encode(
      encoder, source,
      source.edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING : draco::MESH_SEQUENTIAL_ENCODING);
}

std::string draco_cloud_bytes(const DracoSource& source) {
  draco::PointCloud cloud;
  fill(cloud, source);
  draco::ExpertEncoder encoder(cloud);
  return encode(encoder, source, draco::POINT_CLOUD_SEQUENTIAL_ENCODING);
}

DracoSource draco_square() {
  DracoSource source;
  source.points = 4;
  source.indices = {0, 1, 2, 2, 1, 3};
  source.attributes.push_back({});
  source.attributes[0].bytes = floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  return source;
}

DracoSource draco_grid(std::uint32_t side) {
  DracoSource source;
  source.points = side * side;
  std::vector<float> positions;
  for (std::uint32_t i = 0; i < source.points; ++i) {
    const auto most = static_cast<float>(side - 1);
    positions.push_back(static_cast<float>(i % side) / most);
    positions.push_back(static_cast<float>(i / side) / most);
    positions.push_back(0);
    if (i % side + 1 == side || i / side + 1 == side) continue;
    for (const std::uint32_t corner : {i, i + 1, i + side, i + side, i + 1, i + side + 1}) {
      source.indices.push_back(corner);
    }
  }
  source.attributes.push_back({});
  source.attributes[0].bytes = packed(positions);
  return source;
}

}  // namespace gltfx::test
