// SPDX-License-Identifier: Apache-2.0
/// Builds assets with geometry and animations, and reads their numbers after a conversion.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "convert_support.hpp"
#include "model/packed_bytes.hpp"
#include "support/asset_builder.hpp"

namespace gltfx::test {

/// Builds an asset with one buffer view per accessor.
class MadeAsset : public AssetBuilder {
 public:
  MadeAsset() { json["buffers"] = OrderedJson::array(); }

  /// Adds an accessor and returns its index. `type`: "SCALAR", "VEC3".
  template <class T>
  std::size_t accessor(const std::vector<T>& values, const std::string& type, bool bounds = false) {
    bytes.resize((bytes.size() + 7) / 8 * 8);
    OrderedJson more = OrderedJson::object();
    if (bounds) {
      more["min"] = bound(values, width_of(type), false);
      more["max"] = bound(values, width_of(type), true);
    }
    return AssetBuilder::accessor(type, component_type<T>(), values.size() / width_of(type),
                                  packed(values), more);
  }

  /// Adds a mesh with a primitive, and a node with the mesh.
  void mesh(const OrderedJson& primitive) {
    json["meshes"].push_back({{"primitives", {primitive}}});
    json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
  }

  std::string glb() {
    bytes.resize((bytes.size() + 7) / 8 * 8);
    json["buffers"] = {{{"byteLength", bytes.size()}}};
    return glb_of(json.dump(), bytes);
  }

  static std::size_t width_of(const std::string& type) {
    return type == "SCALAR" ? 1 : static_cast<std::size_t>(type[3] - '0');
  }

 private:
  template <class T>
  static int component_type() {
    if (std::is_same_v<T, float>) return 5126;
    if (std::is_same_v<T, std::uint32_t>) return 5125;
    if (std::is_same_v<T, std::int16_t>) return 5122;
    return sizeof(T) == 2 ? 5123 : 5121;
  }
  template <class T>
  static OrderedJson bound(const std::vector<T>& values, std::size_t width, bool most) {
    OrderedJson bounds = OrderedJson::array();
    for (std::size_t k = 0; k < width; ++k) {
      T best = values[k];
      for (std::size_t i = k; i < values.size(); i += width)
        best = most ? std::max(best, values[i]) : std::min(best, values[i]);
      bounds.push_back(best);
    }
    return bounds;
  }
};

template <class T>
double number_at(const std::string& bytes, std::size_t at) {
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return static_cast<double>(value);
}

/// All components of an accessor, element by element.
inline std::vector<double> numbers_of(const StoredAsset& asset, std::size_t index) {
  const OrderedJson json = asset.json();
  const OrderedJson& accessor = json["accessors"][index];
  const OrderedJson& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const int type = accessor["componentType"];
  const std::map<int, std::size_t> sizes{{5120, 1}, {5121, 1}, {5122, 2},
                                         {5123, 2}, {5125, 4}, {5126, 4}};
  const std::size_t size = sizes.at(type);
  const std::size_t width = MadeAsset::width_of(accessor["type"]);
  const std::size_t stride = view.value("byteStride", size * width);
  const std::size_t begin = view.value("byteOffset", 0U) + accessor.value("byteOffset", 0U);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < accessor["count"].get<std::size_t>(); ++i) {
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t at = begin + i * stride + k * size;
      switch (type) {
        case 5126:
          numbers.push_back(number_at<float>(asset.bin, at));
          break;
        case 5125:
          numbers.push_back(number_at<std::uint32_t>(asset.bin, at));
          break;
        case 5123:
          numbers.push_back(number_at<std::uint16_t>(asset.bin, at));
          break;
        case 5122:
          numbers.push_back(number_at<std::int16_t>(asset.bin, at));
          break;
        default:
          numbers.push_back(number_at<std::uint8_t>(asset.bin, at));
      }
    }
  }
  return numbers;
}

/// Runs steps on built assets.
class ConvertMade : public testing::Test {
 protected:
  explicit ConvertMade(ConvertOptions options) : options_(std::move(options)) {}

  std::filesystem::path output() const { return folder_.path() / "out" / "a.glb"; }

  ConvertReport run(const std::string& glb) {
    ConvertOptions options = options_;
    options.output = output().native();
    options.to = StoredAs::glb;
    return convert_file(folder_.write("a.glb", glb).native(), options);
  }

  /// The row of the first step.
  ConvertStep row_of(const std::string& glb) {
    ConvertReport report = run(glb);
    EXPECT_FALSE(report.steps.empty()) << report.error;
    return report.steps.empty() ? ConvertStep() : report.steps.front();
  }

  /// Converts twice; expects that the second conversion changes nothing.
  StoredAsset converted_twice(const std::string& glb) {
    const ConvertReport report = run(glb);
    EXPECT_TRUE(report.written) << report.error;
    EXPECT_TRUE(report.steps[0].changes) << report.steps[0].what;
    row_ = report.steps[0];
    const std::string once = container::test::content_of(output());
    const ConvertReport again = run(once);
    EXPECT_FALSE(again.changes) << again.steps[0].what;
    EXPECT_EQ(container::test::content_of(output()), once);
    return StoredAsset(once);
  }

  /// Expects no change and one note with this reason.
  void expect_left(MadeAsset& asset, const std::string& reason) {
    const ConvertStep row = row_of(asset.glb());
    EXPECT_FALSE(row.changes);
    ASSERT_EQ(row.left.size(), 1U) << reason;
    EXPECT_EQ(row.left[0].reason, reason);
    EXPECT_TRUE(row.refused.empty());
  }
  void expect_refused(MadeAsset& asset, const std::string& pointer, const std::string& reason) {
    const ConvertReport report = run(asset.glb());
    EXPECT_FALSE(report.written);
    EXPECT_EQ(report.problem, EditProblem::refused);
    ASSERT_EQ(report.steps.at(0).refused.size(), 1U) << reason;
    EXPECT_EQ(report.steps[0].refused[0].pointer, pointer);
    EXPECT_EQ(report.steps[0].refused[0].reason, reason);
  }

  ConvertOptions options_;
  container::test::TempFolder folder_;
  ConvertStep row_;
};

}  // namespace gltfx::test
