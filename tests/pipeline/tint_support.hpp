// SPDX-License-Identifier: Apache-2.0
/// Documents with a legacy material, vertex colours and animations, upgraded in a folder of their
/// own.
#pragma once

#include <gltfx/pipeline.hpp>

#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/base64.hpp"
#include "container/temp_folder.hpp"
#include "json/parse.hpp"
#include "pipeline/scene_asset.hpp"
#include "steps/upgrade/vertex_colors.hpp"
#include "support/asset_builder.hpp"

namespace gltfx::test {

using container::test::TempFolder;
using Json = nlohmann::ordered_json;

inline constexpr const char* kOld = "KHR_materials_translucency";
inline constexpr const char* kNew = "KHR_materials_diffuse_transmission";
inline constexpr int kByte = 5121;
inline constexpr int kShort = 5123;

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// A document with one legacy material, triangles and animations, all in one buffer.
class Scene {
 public:
  Scene() {
    made_.json = {{"asset", {{"version", "2.0"}}},
                  {"extensionsUsed", {kOld}},
                  {"materials",
                   {{{"name", "leaf"},
                     {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 0.5}}}},
                     {"extensions", {{kOld, {{"translucencyFactor", 0.5}}}}}}}}};
    positions_ = add_accessor(bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}), kFloat, "VEC3", 3);
    made_.json["accessors"][0]["min"] = {0, 0, 0};
    made_.json["accessors"][0]["max"] = {1, 1, 0};
  }
  Json& json() { return made_.json; }
  Json& primitive(std::size_t i) { return made_.json["meshes"][0]["primitives"][i]; }

  std::size_t add_accessor(const std::string& bytes, int component, const char* type, int count) {
    Json more = Json::object();
    if (component != kFloat) more["normalized"] = true;
    return made_.accessor(type, component, static_cast<std::size_t>(count), bytes, more);
  }
  std::size_t add_primitive() {
    made_.json["meshes"][0]["primitives"].push_back(
        {{"attributes", {{"POSITION", positions_}}}, {"material", 0}});
    return made_.json["meshes"][0]["primitives"].size() - 1;
  }
  /// A triangle with that colour at each vertex, RGBA of bytes.
  std::size_t add_colored(const std::vector<std::array<std::uint8_t, 4>>& colors) {
    std::vector<std::uint8_t> flat;
    for (const auto& color : colors) flat.insert(flat.end(), color.begin(), color.end());
    const std::size_t primitive = add_primitive();
    this->primitive(primitive)["attributes"]["COLOR_0"] =
        add_accessor(bytes_of(flat), kByte, "VEC4", 3);
    return primitive;
  }
  std::size_t add_uniform(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    return add_colored(std::vector<std::array<std::uint8_t, 4>>(3, {r, g, b, 77}));
  }
  /// A channel that moves what `pointer` leads to.
  void animate(const std::string& pointer, std::size_t output, const char* interpolation = "LINEAR",
               std::size_t index = 0) {
    const std::size_t input = add_accessor(bytes_of<float>({0, 1}), kFloat, "SCALAR", 2);
    made_.json["accessors"][input]["min"] = {0};
    made_.json["accessors"][input]["max"] = {1};
    Json& animation = made_.json["animations"][index];
    animation["samplers"].push_back(
        {{"input", input}, {"output", output}, {"interpolation", interpolation}});
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size() - 1},
         {"target",
          {{"path", "pointer"},
           {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}});
  }
  std::string text() {
    made_.json["buffers"] = {
        {{"byteLength", made_.bytes.size()},
         {"uri", "data:application/octet-stream;base64," + container::encode_base64(made_.bytes)}}};
    if (made_.json.contains("animations"))
      made_.json["extensionsUsed"].push_back("KHR_animation_pointer");
    // Compilers differ in whether braces around one value make an array of it.
    made_.json["scenes"] = Json::array({Json{{"nodes", Json::array({0})}}});
    made_.json["nodes"] = Json::array();
    made_.json["nodes"].push_back(made_.json.contains("meshes") ? Json{{"mesh", 0}}
                                                                : Json::object());
    return made_.json.dump(2);
  }

 private:
  AssetBuilder made_;
  std::size_t positions_ = 0;
};

inline std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Upgraded {
  UpgradeReport report;
  Json json;
  std::string text;
  const UpgradeAction& action() const { return report.actions.at(0); }
  const Json& extension(std::size_t material = 0) const {
    return json["materials"][material]["extensions"][kNew];
  }
};

// In place, and once more, which must change nothing.
inline Upgraded upgraded(Scene scene) {
  const TempFolder folder;
  const std::string path = folder.write("a.gltf", scene.text()).native();
  UpgradeOptions options;
  options.in_place = true;
  Upgraded result{upgrade_file(path, options), {}, content(path)};
  result.json = Json::parse(result.text);
  EXPECT_EQ(result.report.problem, EditProblem::none) << result.report.error;
  if (!result.report.written) return result;
  EXPECT_FALSE(upgrade_file(path, options).changes);
  for (const Diagnostic& finding : validate_file(path).diagnostics) {
    EXPECT_NE(finding.severity, Severity::error) << finding.code << ": " << finding.message;
  }
  return result;
}

// The numbers of an accessor, normalized.
inline std::vector<double> numbers_of(const std::string& text, std::size_t accessor) {
  const json::Parsed parsed = json::parse(std::string_view(text));
  const model::Asset asset(parsed.document);
  const auto container = container::open_bytes(container::Bytes::from_string(text));
  const container::Resolver resolver(".", ".");
  model::AssetBytes bytes(asset, container, resolver);
  upgrade::AccessorValues values(asset, &bytes);
  const auto data = values.open(accessor);
  std::vector<double> numbers;
  if (!data) return numbers;
  model::with_component_type(data->format().component, [&](auto type) {
    using T = decltype(type);
    data->visit<T>([&](const T* at, std::size_t elements, std::uint64_t) {
      for (std::size_t i = 0; i < elements * data->components(); ++i) {
        if constexpr (std::is_floating_point_v<T>) {
          numbers.push_back(at[i]);
        } else {
          numbers.push_back(model::normalize(at[i]));
        }
      }
    });
  });
  return numbers;
}

}  // namespace gltfx::test
