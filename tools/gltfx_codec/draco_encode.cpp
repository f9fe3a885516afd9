// SPDX-License-Identifier: Apache-2.0
#include "draco_encode.hpp"

#include <array>
#include <string_view>
#include <vector>

#include <draco/compression/expert_encode.h>

#include "base/equal_records.hpp"
#include "codec/draco_source.hpp"

namespace gltfx::codec {
namespace {

using draco::AttributeValueIndex;
using draco::FaceIndex;
using draco::PointIndex;

draco::DataType type_of(Component component) {
  constexpr std::array<draco::DataType, 7> kTypes{
      draco::DT_INT8,  draco::DT_UINT8,  draco::DT_INT16,  draco::DT_UINT16,
      draco::DT_INT32, draco::DT_UINT32, draco::DT_FLOAT32};
  return kTypes[static_cast<std::size_t>(component)];
}

draco::GeometryAttribute::Type kind_of(DracoUse use) {
  constexpr std::array<draco::GeometryAttribute::Type, 5> kKinds{
      draco::GeometryAttribute::POSITION, draco::GeometryAttribute::NORMAL,
      draco::GeometryAttribute::COLOR, draco::GeometryAttribute::TEX_COORD,
      draco::GeometryAttribute::GENERIC};
  return kKinds[static_cast<std::size_t>(use)];
}

/// Distinct values of an attribute, and the value of each point.
struct Values {
  std::vector<std::uint32_t> of_points;
  std::vector<std::uint32_t> firsts;  ///< the first point with each value
};

// Draco's own search compares floats as numbers: -0 would become 0. `equal`: the first point with
// the same value, by point. Points that are `alone` get a separate value.
Values distinct_values(const std::vector<std::uint32_t>& equal, const std::vector<bool>& alone) {
  Values values;
  values.of_points.resize(equal.size());
  constexpr std::uint32_t kNone = UINT32_MAX;
  std::vector<std::uint32_t> shared(alone.empty() ? 0 : equal.size(), kNone);
  for (std::uint32_t i = 0; i < equal.size(); ++i) {
    const auto next = static_cast<std::uint32_t>(values.firsts.size());
    if (alone.empty()) {
      values.of_points[i] = equal[i] == i ? next : values.of_points[equal[i]];
    } else if (alone[i]) {
      values.of_points[i] = next;
    } else {
      std::uint32_t& known = shared[equal[i]];
      if (known == kNone) known = next;
      values.of_points[i] = known;
    }
    if (values.of_points[i] == next) values.firsts.push_back(i);
  }
  return values;
}

// Points of triangles with two corners at the same position; empty: there are none. Draco
// distinguishes corners by position, and omits such triangles.
std::vector<bool> find_collapsed(const DracoMesh& mesh, const std::vector<std::uint32_t>& equal) {
  std::vector<bool> collapsed;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto corners = mesh.indices.subspan(i, 3);
    const auto at = [&](std::size_t k) { return equal[corners[k]]; };
    if (at(0) != at(1) && at(1) != at(2) && at(2) != at(0)) continue;
    collapsed.resize(mesh.points);
    for (const std::uint32_t corner : corners) collapsed[corner] = true;
  }
  return collapsed;
}

void add(draco::Mesh& to, const DracoAttribute& attribute, const Values& values) {
  const std::size_t size = value_size(attribute);
  draco::GeometryAttribute description;
  description.Init(kind_of(attribute.use), nullptr, static_cast<std::uint8_t>(attribute.components),
                   type_of(attribute.component), attribute.normalized,
                   static_cast<std::int64_t>(size), 0);
  const int index =
      to.AddAttribute(description, false, static_cast<std::uint32_t>(values.firsts.size()));
  draco::PointAttribute& added = *to.attribute(index);
  for (std::uint32_t i = 0; i < values.firsts.size(); ++i) {
    added.SetAttributeValue(AttributeValueIndex(i),
                            attribute.values.data() + values.firsts[i] * size);
  }
  for (std::uint32_t i = 0; i < values.of_points.size(); ++i) {
    added.SetPointMapEntry(PointIndex(i), AttributeValueIndex(values.of_points[i]));
  }
  added.set_unique_id(attribute.id);
}

void fill(draco::Mesh& to, const DracoMesh& mesh) {
  to.set_num_points(mesh.points);
  to.SetNumFaces(mesh.faces);
  for (std::uint32_t i = 0; i < mesh.faces; ++i) {
    to.SetFace(FaceIndex(i), {PointIndex(mesh.indices[i * std::size_t{3}]),
                              PointIndex(mesh.indices[i * std::size_t{3} + 1]),
                              PointIndex(mesh.indices[i * std::size_t{3} + 2])});
  }
  for (const DracoAttribute& attribute : mesh.attributes) {
    const std::string_view bytes(reinterpret_cast<const char*>(attribute.values.data()),
                                 attribute.values.size());
    const std::vector<std::uint32_t> equal = first_equal_records(bytes, value_size(attribute));
    const bool is_position = attribute.use == DracoUse::position;
    const Values values =
        distinct_values(equal, is_position ? find_collapsed(mesh, equal) : std::vector<bool>());
    add(to, attribute, values);
  }
}

draco::Status encode(const draco::Mesh& mesh, int speed, draco::EncoderBuffer& to) {
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetSpeedOptions(speed, speed);
  return encoder.EncodeToBuffer(&to);
}

}  // namespace

Answer encode_draco(std::span<const std::byte> payload, const Output& output) {
  const auto source = unpack(payload);
  if (!source) return DecodeError{ErrorKind::malformed, "The mesh is inconsistent."};
  draco::Mesh mesh;
  fill(mesh, *source);
  draco::EncoderBuffer quick;
  draco::EncoderBuffer slow;
  const draco::Status status = encode(mesh, 5, quick);
  if (!status.ok()) return DecodeError{ErrorKind::malformed, status.error_msg_string()};
  const bool shorter = encode(mesh, 0, slow).ok() && slow.size() < quick.size();
  const draco::EncoderBuffer& best = shorter ? slow : quick;
  return hand_over(std::as_bytes(std::span(best.data(), best.size())), output);
}

}  // namespace gltfx::codec
