// SPDX-License-Identifier: Apache-2.0
/// Creates small assets with geometry, and reads the bytes of stored ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "container/opened_files.hpp"
#include "convert_support.hpp"
#include "model/opened_asset.hpp"
#include "model/resource_data.hpp"
#include "support/asset_builder.hpp"

namespace gltfx::test {

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// A slightly bent square of `side` times `side` points.
struct Grid {
  explicit Grid(unsigned side = 16) {
    const auto part = [&](unsigned at) {
      return static_cast<float>(at) / static_cast<float>(side - 1);
    };
    for (unsigned y = 0; y < side; ++y) {
      for (unsigned x = 0; x < side; ++x) {
        positions.insert(positions.end(), {part(x), part(y), std::sin(part(x) * 3 + part(y))});
        texcoords.insert(texcoords.end(), {part(x), part(y)});
        if (x + 1 == side || y + 1 == side) continue;
        const auto at = static_cast<std::uint16_t>(y * side + x);
        const auto up = static_cast<std::uint16_t>(at + side);
        const auto next = static_cast<std::uint16_t>(at + 1);
        const auto far = static_cast<std::uint16_t>(up + 1);
        indices.insert(indices.end(), {at, next, up, next, far, up});
      }
    }
  }
  std::vector<float> positions, texcoords;
  std::vector<std::uint16_t> indices;
};

/// Builds a document with one buffer, "b.bin".
class AssetText : public AssetBuilder {
 public:
  AssetText() { json["scene"] = 0; }
  /// Returns the index of the accessor. `component`: the glTF number of the type.
  template <class T>
  std::size_t accessor(const std::vector<T>& values, unsigned component, const char* type,
                       unsigned components, const OrderedJson& more = OrderedJson::object()) {
    return accessor_at(view(bytes_of(values)), values.size() / components, component, type, more);
  }
  std::size_t accessor_at(std::size_t view, std::size_t count, unsigned component, const char* type,
                          OrderedJson more = OrderedJson::object()) {
    more["bufferView"] = view;
    more["componentType"] = component;
    more["count"] = count;
    more["type"] = type;
    return add("accessors", std::move(more));
  }
  /// Adds accessors of a grid: POSITION, TEXCOORD_0 and indices. Returns the primitive.
  OrderedJson grid(const Grid& grid = Grid()) {
    std::vector<float> least(3, INFINITY), most(3, -INFINITY);
    for (std::size_t i = 0; i < grid.positions.size(); ++i) {
      least[i % 3] = std::min(least[i % 3], grid.positions[i]);
      most[i % 3] = std::max(most[i % 3], grid.positions[i]);
    }
    OrderedJson primitive;
    primitive["attributes"]["POSITION"] =
        accessor(grid.positions, 5126, "VEC3", 3, {{"min", least}, {"max", most}});
    primitive["attributes"]["TEXCOORD_0"] = accessor(grid.texcoords, 5126, "VEC2", 2);
    primitive["indices"] = accessor(grid.indices, 5123, "SCALAR", 1);
    return primitive;
  }
  void mesh(const OrderedJson& primitive) {
    json["meshes"].push_back({{"primitives", OrderedJson::array({primitive})}});
    json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
    json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
  }
  std::string text() {
    json["buffers"] = OrderedJson::array({{{"uri", "b.bin"}, {"byteLength", bytes.size()}}});
    return json.dump(1);
  }
  std::filesystem::path write(container::test::TempFolder& folder) {
    const std::string now = text();
    folder.write("b.bin", bytes);
    return folder.write("a.gltf", now);
  }
};

/// The decoded bytes of each buffer view; "none": there are none.
inline std::vector<std::string> view_bytes(const std::filesystem::path& path) {
  const model::OpenedAsset opened(path.native(), *container::open_file(path.native()),
                                  container::Resolver(path.parent_path(), path.parent_path()));
  const model::Asset asset(opened.document());
  container::OpenedFiles files(opened.resolver());
  const auto loaded = model::load_resources(opened.container(), files, asset, opened.views(), 1);
  std::vector<std::string> all;
  for (const model::BufferView& view : opened.views().buffer_views) {
    const auto bytes = loaded.data.part(asset.document(), view, 0, view.byte_length.value_or(0));
    all.emplace_back(bytes ? bytes->text() : "none");
  }
  return all;
}

/// The row of a step; expects that it ran.
inline const ConvertStep& step_of(const ConvertReport& report, std::string_view name) {
  const auto found = std::find_if(report.steps.begin(), report.steps.end(),
                                  [&](const ConvertStep& step) { return step.step == name; });
  EXPECT_NE(found, report.steps.end()) << name;
  static const ConvertStep kNone;
  return found == report.steps.end() ? kNone : *found;
}

/// "/pointer: reason" of each note.
inline std::vector<std::string> texts_of(const std::vector<ConvertNote>& notes) {
  std::vector<std::string> texts;
  for (const ConvertNote& note : notes) texts.push_back(note.pointer + ": " + note.reason);
  return texts;
}

}  // namespace gltfx::test
