// SPDX-License-Identifier: Apache-2.0
/// Makes valid and unusual Draco bitstreams for tests.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gltfx::test {

struct DracoSource {
  enum class Kind : std::uint8_t { position, normal, color, tex_coord, generic };
  enum class Type : std::uint8_t { int8, uint8, int16, uint16, uint32, float32, float64 };
  struct Attribute {
    Kind kind = Kind::position;
    Type type = Type::float32;
    unsigned components = 3;
    std::string bytes;     ///< data of all points, packed
    std::uint32_t id = 0;  ///< unique
    int bits = 0;          ///< bits of quantisation; 0: none
    bool normalized = false;
  };
  std::uint32_t points = 0;
  std::vector<std::uint32_t> indices;  ///< three per triangle
  std::vector<Attribute> attributes;
  bool edgebreaker = false;  ///< renumbers the points; otherwise their order is kept
};

std::string draco_bytes(const DracoSource& source);
/// The points without triangles.
std::string draco_cloud_bytes(const DracoSource& source);

/// A square of two triangles in the plane z = 0, from (0, 0) to (1, 1); attribute 0.
DracoSource draco_square();
/// A grid of `side` x `side` points, from (0, 0, 0) to (1, 1, 0); attribute 0.
DracoSource draco_grid(std::uint32_t side);

}  // namespace gltfx::test
