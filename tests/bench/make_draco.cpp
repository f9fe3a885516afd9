// SPDX-License-Identifier: Apache-2.0
// Writes a workload of compressed geometry: eight hills of 217,000 triangles, each with positions,
// normals and texture coordinates as encoders quantise them by default.
//
//   make_draco FILE.glb
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "codec/support/draco_encoder.hpp"
#include "model/packed_bytes.hpp"

namespace {

using gltfx::test::DracoSource;

constexpr std::uint32_t kSide = 330;

DracoSource hill(float phase) {
  DracoSource source = gltfx::test::draco_grid(kSide);
  std::vector<float> positions, normals, coordinates;
  for (std::uint32_t i = 0; i < source.points; ++i) {
    const float x = static_cast<float>(i % kSide) / (kSide - 1);
    const float y = static_cast<float>(i / kSide) / (kSide - 1);
    const float slope_x = std::cos(9 * x + phase) * 0.9F, slope_y = -std::sin(7 * y + phase) * 0.7F;
    const float length = std::sqrt(slope_x * slope_x + slope_y * slope_y + 1);
    const float height = 0.1F * (std::sin(9 * x + phase) + std::cos(7 * y + phase));
    for (const float value : {x, y, height}) positions.push_back(value);
    for (const float value : {-slope_x, -slope_y, 1.0F}) normals.push_back(value / length);
    for (const float value : {x, y}) coordinates.push_back(value);
  }
  using Kind = DracoSource::Kind;
  constexpr auto kFloat = DracoSource::Type::float32;
  using gltfx::test::packed;
  source.attributes = {{Kind::position, kFloat, 3, packed(positions), 0, 11, false},
                       {Kind::normal, kFloat, 3, packed(normals), 1, 8, false},
                       {Kind::tex_coord, kFloat, 2, packed(coordinates), 2, 10, false}};
  source.edgebreaker = true;
  return source;
}

std::string member(const char* text, std::size_t number) { return text + std::to_string(number); }

std::string accessor(const char* type, std::size_t count, const char* more) {
  return std::string(R"({"componentType": 5126, "type": ")") + type + R"(", "count": )" +
         std::to_string(count) + more + "}";
}

void append_word(std::string& to, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) to += static_cast<char>(value >> shift & 0xFFU);
}

std::string glb(std::string json, const std::string& bin) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string file = "glTF";
  append_word(file, 2);
  append_word(file, 12 + 8 + json.size() + 8 + bin.size());
  append_word(file, json.size());
  file += "JSON" + json;
  append_word(file, bin.size());
  return file + std::string("BIN\0", 4) + bin;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::string bin, views, accessors, primitives;
  for (std::size_t i = 0; i < 8; ++i) {
    const DracoSource source = hill(static_cast<float>(i));
    const std::string bytes = gltfx::test::draco_bytes(source);
    const std::string comma = i == 0 ? "" : ", ";
    views += comma + member(R"({"buffer": 0, "byteOffset": )", bin.size()) +
             member(R"(, "byteLength": )", bytes.size()) + "}";
    bin += bytes;
    bin.resize((bin.size() + 3) / 4 * 4);
    accessors +=
        comma + accessor("VEC3", source.points, R"(, "min": [0, 0, -0.2], "max": [1, 1, 0.2])") +
        ", " + accessor("VEC3", source.points, "") + ", " + accessor("VEC2", source.points, "") +
        member(R"(, {"componentType": 5125, "type": "SCALAR", "count": )", source.indices.size()) +
        "}";
    primitives += comma + member(R"({"attributes": {"POSITION": )", 4 * i) +
                  member(R"(, "NORMAL": )", 4 * i + 1) + member(R"(, "TEXCOORD_0": )", 4 * i + 2) +
                  member(R"(}, "indices": )", 4 * i + 3) +
                  member(R"(, "extensions": {"KHR_draco_mesh_compression": {"bufferView": )", i) +
                  R"(, "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}}}})";
  }
  const std::string json =
      R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_draco_mesh_compression"],
 "extensionsRequired": ["KHR_draco_mesh_compression"], "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0}], "meshes": [{"primitives": [)" +
      primitives + R"(]}], "accessors": [)" + accessors + R"(], "bufferViews": [)" + views +
      member(R"(], "buffers": [{"byteLength": )", bin.size()) + "}]}";
  std::FILE* file = std::fopen(argv[1], "wb");
  if (file == nullptr) return 3;
  const std::string all = glb(json, bin);
  const bool written = std::fwrite(all.data(), 1, all.size(), file) == all.size();
  return std::fclose(file) == 0 && written ? 0 : 3;
}
