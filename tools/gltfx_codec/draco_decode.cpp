// SPDX-License-Identifier: Apache-2.0
#include "draco_decode.hpp"

#include <cmath>
#include <cstring>
#include <memory>
#include <string>

#include <draco/attributes/attribute_octahedron_transform.h>
#include <draco/attributes/attribute_quantization_transform.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>

namespace gltfx::codec {
namespace {

using draco::PointAttribute;
using draco::PointIndex;

DecodeError malformed(std::string message) { return {ErrorKind::malformed, std::move(message)}; }

Component component_of(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return Component::int8;
    case draco::DT_UINT8:
      return Component::uint8;
    case draco::DT_INT16:
      return Component::int16;
    case draco::DT_UINT16:
      return Component::uint16;
    case draco::DT_INT32:
      return Component::int32;
    case draco::DT_UINT32:
      return Component::uint32;
    case draco::DT_FLOAT32:
      return Component::float32;
    default:
      return Component::other;
  }
}

DracoUse use_of(draco::GeometryAttribute::Type type) {
  switch (type) {
    case draco::GeometryAttribute::POSITION:
      return DracoUse::position;
    case draco::GeometryAttribute::NORMAL:
      return DracoUse::normal;
    case draco::GeometryAttribute::COLOR:
      return DracoUse::color;
    case draco::GeometryAttribute::TEX_COORD:
      return DracoUse::tex_coord;
    default:
      return DracoUse::generic;
  }
}

// Distance of the values of an attribute, from the integers that it was decoded from; 0 if it was
// not quantised.
double quantization_step(const PointAttribute* portable) {
  const auto* transform = portable == nullptr ? nullptr : portable->GetAttributeTransformData();
  if (transform == nullptr) return 0;
  double step = 0;
  if (transform->transform_type() == draco::ATTRIBUTE_QUANTIZATION_TRANSFORM) {
    draco::AttributeQuantizationTransform quantization;
    if (!quantization.InitFromAttribute(*portable)) return 0;
    step = double{quantization.range()} / (std::exp2(quantization.quantization_bits()) - 1);
  } else if (transform->transform_type() == draco::ATTRIBUTE_OCTAHEDRON_TRANSFORM) {
    draco::AttributeOctahedronTransform octahedron;
    if (!octahedron.InitFromAttribute(*portable)) return 0;
    // The square is 2 wide; mapping it to the sphere stretches it by at most the same factor.
    step = 4 / (std::exp2(octahedron.quantization_bits()) - 1);
  }
  return std::isfinite(step) ? std::abs(step) : 0;
}

DracoAttribute describe(const PointAttribute& attribute, const PointAttribute* portable) {
  DracoAttribute description;
  description.id = attribute.unique_id();
  description.use = use_of(attribute.attribute_type());
  description.component = component_of(attribute.data_type());
  description.components = attribute.num_components();
  description.normalized = attribute.normalized();
  description.quantization_step = quantization_step(portable);
  return description;
}

// Writes the value of each point. False if the decoder's tables are inconsistent.
bool write_values(const PointAttribute& attribute, std::size_t size, std::uint32_t points,
                  std::span<std::byte> to) {
  if (to.empty()) return true;
  if (attribute.byte_stride() != static_cast<std::int64_t>(size)) return false;
  const auto* values = reinterpret_cast<const std::byte*>(attribute.buffer()->data());
  const std::size_t count = attribute.buffer()->data_size() / size;
  for (std::uint32_t i = 0; i < points; ++i) {
    const std::size_t from = attribute.mapped_index(PointIndex(i)).value();
    if (from >= count) return false;
    std::memcpy(to.data() + i * size, values + from * size, size);
  }
  return true;
}

// Draco's entry point does not give access to the decoder, which is the only source of the
// quantisation.
std::unique_ptr<draco::MeshDecoder> decoder_for(const draco::DracoHeader& header) {
  if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
    return std::make_unique<draco::MeshSequentialDecoder>();
  }
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
    return std::make_unique<draco::MeshEdgebreakerDecoder>();
  }
  return nullptr;
}

// The least memory for the sizes at the start of a bitstream. The decoder allocates it before it
// checks whether the stream can have this amount of data.
std::uint64_t promised_bytes(draco::DecoderBuffer& buffer, const draco::DracoHeader& header) {
  constexpr int kVersion = 2;  // earlier versions stored sizes differently
  if (header.version_major < kVersion || (header.flags & METADATA_FLAG_MASK) != 0) return 0;
  std::uint32_t points = 0;
  std::uint32_t faces = 0;
  std::uint8_t traversal = 0;
  const bool edgebreaker = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING;
  if (edgebreaker && !buffer.Decode(&traversal)) return 0;
  std::uint32_t& first = edgebreaker ? points : faces;
  std::uint32_t& second = edgebreaker ? faces : points;
  if (!draco::DecodeVarint(&first, &buffer) || !draco::DecodeVarint(&second, &buffer)) return 0;
  return (std::uint64_t{points} + faces) * 12;
}

Answer write_result(draco::MeshDecoder& decoder, const draco::Mesh& decoded, const Output& output) {
  DracoMesh mesh;
  mesh.points = decoded.num_points();
  mesh.faces = decoded.num_faces();
  if (static_cast<std::size_t>(decoded.num_attributes()) > kMostAttributes) {
    return malformed("The mesh has too many attributes.");
  }
  for (std::int32_t i = 0; i < decoded.num_attributes(); ++i) {
    mesh.attributes.push_back(describe(*decoded.attribute(i), decoder.GetPortableAttribute(i)));
  }
  const std::uint64_t size = result_size(mesh).value_or(0);
  const std::span<std::byte> to = output(size);
  if (to.size() < size) throw std::bad_alloc();
  if (mesh.faces != 0) {
    const void* faces = &decoded.face(draco::FaceIndex(0));  // three 32-bit indices each
    std::memcpy(to.data(), faces, std::size_t{mesh.faces} * 12);
  }
  bool sound = true;
  std::int32_t index = 0;
  for_each_values(mesh, [&](std::uint64_t offset, std::uint64_t length) {
    const DracoAttribute& attribute = mesh.attributes[static_cast<std::size_t>(index)];
    sound = sound && write_values(*decoded.attribute(index), value_size(attribute), mesh.points,
                                  to.subspan(offset, length));
    ++index;
  });
  return sound ? Answer(std::move(mesh)) : Answer(malformed("The attributes have no values."));
}

}  // namespace

Answer decode_draco(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::DracoHeader header;
  draco::DecoderBuffer ahead(buffer);
  const draco::Status read = draco::PointCloudDecoder::DecodeHeader(&ahead, &header);
  if (!read.ok()) return malformed(read.error_msg_string());
  if (header.encoder_type != draco::TRIANGULAR_MESH) {
    return malformed("It is a point cloud, not a mesh.");
  }
  if (promised_bytes(ahead, header) > job.memory_bytes) {
    return DecodeError{ErrorKind::out_of_memory, "Decoding exceeds the memory limit."};
  }
  const auto decoder = decoder_for(header);
  if (decoder == nullptr) return malformed("Its encoding is unknown.");
  draco::Mesh mesh;
  const draco::Status decoded = decoder->Decode(draco::DecoderOptions(), &buffer, &mesh);
  if (!decoded.ok()) return malformed(decoded.error_msg_string());
  return write_result(*decoder, mesh, output);
}

}  // namespace gltfx::codec
