// SPDX-License-Identifier: Apache-2.0
#include "codec/draco_source.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "base/equal_records.hpp"
#include "codec/protocol.hpp"

namespace gltfx::codec {
namespace {

// A payload: size of the description, the description as in an answer, indices and values.
constexpr std::size_t kAlignment = 8;

std::size_t aligned(std::size_t size) { return (size + kAlignment - 1) / kAlignment * kAlignment; }

bool ids_repeat(const DracoMesh& mesh) {
  std::vector<std::uint32_t> ids;
  for (const DracoAttribute& attribute : mesh.attributes) ids.push_back(attribute.id);
  std::sort(ids.begin(), ids.end());
  return std::adjacent_find(ids.begin(), ids.end()) != ids.end();
}

std::string flaw_of_indices(const DracoMesh& mesh) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::uint32_t a = mesh.indices[i];
    const std::uint32_t b = mesh.indices[i + 1];
    const std::uint32_t c = mesh.indices[i + 2];
    if (std::max({a, b, c}) >= mesh.points) return "An index refers to a missing vertex.";
    if (a == b || b == c || c == a) return "A triangle has a vertex twice.";
  }
  return {};
}

using Triangle = std::array<std::uint32_t, 3>;

/// Numbers for the points of meshes, such that equal numbers are equal values of all attributes.
class Points {
 public:
  /// Adds the points of a mesh. `order` has its attributes, by their place; those of the meshes
  /// have the same sizes.
  void add(const DracoMesh& mesh, const std::vector<std::size_t>& order) {
    row_ = 0;
    for (const DracoAttribute& attribute : mesh.attributes) row_ += value_size(attribute);
    rows_.reserve(rows_.size() + row_ * mesh.points);
    for (std::uint32_t i = 0; i < mesh.points; ++i) {
      for (const std::size_t each : order) {
        const std::size_t size = value_size(mesh.attributes[each]);
        const auto value = mesh.attributes[each].values.subspan(i * size, size);
        rows_.insert(rows_.end(), value.begin(), value.end());
      }
    }
  }

  /// Of each point, in the order of add().
  std::vector<std::uint32_t> number() const {
    return first_equal_records({reinterpret_cast<const char*>(rows_.data()), rows_.size()}, row_);
  }

 private:
  std::size_t row_ = 0;  ///< bytes of all values of a point
  std::vector<std::byte> rows_;
};

// The position of the attribute with the same id, or nothing if it does not exist or has another
// type.
std::optional<std::size_t> find_twin(const DracoAttribute& attribute, const DracoMesh& mesh) {
  for (std::size_t i = 0; i < mesh.attributes.size(); ++i) {
    const DracoAttribute& other = mesh.attributes[i];
    if (other.id != attribute.id) continue;
    const bool same = other.component == attribute.component &&
                      other.components == attribute.components &&
                      other.normalized == attribute.normalized;
    return same ? std::optional(i) : std::nullopt;
  }
  return std::nullopt;
}

std::vector<Triangle> sorted_triangles(const DracoMesh& mesh,
                                       std::span<const std::uint32_t> numbers) {
  std::vector<Triangle> triangles(mesh.faces);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto corner = [&](std::size_t k) { return numbers[mesh.indices[i * 3 + k % 3]]; };
    triangles[i] = {corner(0), corner(1), corner(2)};
    for (std::size_t k = 1; k < 3; ++k) {
      triangles[i] = std::min(triangles[i], {corner(k), corner(k + 1), corner(k + 2)});
    }
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace

std::string find_flaw(const DracoMesh& mesh) {
  if (mesh.faces == 0) return "The mesh has no triangles.";
  if (mesh.indices.size() != std::size_t{mesh.faces} * 3) return "The indices are incomplete.";
  if (mesh.attributes.size() > kMostAttributes) return "The mesh has too many attributes.";
  std::size_t positions = 0;
  for (const DracoAttribute& attribute : mesh.attributes) {
    const std::size_t size = value_size(attribute);
    if (size == 0 || attribute.components > 127) return "An attribute has an unsupported type.";
    if (attribute.values.size() != size * mesh.points) return "The values are incomplete.";
    if (attribute.use == DracoUse::position) ++positions;
  }
  if (positions != 1) return "The mesh does not have exactly one position attribute.";
  if (ids_repeat(mesh)) return "Two attributes have the same id.";
  return flaw_of_indices(mesh);
}

std::vector<std::byte> pack(const DracoMesh& mesh) {
  const Frame description = write_answer(mesh);
  const std::uint64_t length = description.size();
  const std::size_t begin = aligned(sizeof length + description.size());
  std::vector<std::byte> payload(begin + static_cast<std::size_t>(*result_size(mesh)));
  std::memcpy(payload.data(), &length, sizeof length);
  std::memcpy(payload.data() + sizeof length, description.data(), description.size());
  std::memcpy(payload.data() + begin, mesh.indices.data(), mesh.indices.size_bytes());
  auto attribute = mesh.attributes.begin();
  for_each_values(mesh, [&](std::uint64_t offset, std::uint64_t size) {
    std::memcpy(payload.data() + begin + offset, attribute++->values.data(), size);
  });
  return payload;
}

std::optional<DracoMesh> unpack(std::span<const std::byte> payload) {
  std::uint64_t length = 0;
  if (payload.size() < sizeof length) return std::nullopt;
  std::memcpy(&length, payload.data(), sizeof length);
  if (length > std::min(payload.size() - sizeof length, kMostFrameBytes)) return std::nullopt;
  auto answer = read_answer(payload.subspan(sizeof length, length));
  auto* mesh = answer ? std::get_if<DracoMesh>(&*answer) : nullptr;
  const std::size_t begin = aligned(sizeof length + length);
  if (mesh == nullptr || begin > payload.size()) return std::nullopt;
  if (!attach(*mesh, payload.subspan(begin)) || !find_flaw(*mesh).empty()) return std::nullopt;
  return std::move(*mesh);
}

bool have_same_triangles(const DracoMesh& a, const DracoMesh& b) {
  if (a.faces != b.faces || a.attributes.size() != b.attributes.size()) return false;
  std::vector<std::size_t> own;
  std::vector<std::size_t> twins;
  for (std::size_t i = 0; i < a.attributes.size(); ++i) {
    const auto twin = find_twin(a.attributes[i], b);
    if (!twin) return false;
    own.push_back(i);
    twins.push_back(*twin);
  }
  Points points;
  points.add(a, own);
  points.add(b, twins);
  const std::vector<std::uint32_t> numbers = points.number();
  const std::span<const std::uint32_t> all(numbers);
  return sorted_triangles(a, all.first(a.points)) == sorted_triangles(b, all.subspan(a.points));
}

}  // namespace gltfx::codec
