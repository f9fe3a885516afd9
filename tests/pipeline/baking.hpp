// SPDX-License-Identifier: Apache-2.0
/// Assets that a test writes, drawn through the library's door, and the numbers of their pictures.
#pragma once

#include <gltfx/pipeline.hpp>

#include <cmath>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "codec/client.hpp"
#include "container/temp_folder.hpp"
#include "model/packed_bytes.hpp"
#include "pipeline/picture_file.hpp"
#include "render/shapes.hpp"
#include "support/asset_builder.hpp"

namespace gltfx::test {

using Json = nlohmann::ordered_json;

template <typename T>
std::string packed(const SharedArray<T>& values) {
  return packed(std::vector<T>(values.begin(), values.end()));
}

/// A document that grows, with a buffer inside.
class AssetText {
 public:
  AssetText() {
    json()["scene"] = 0;
    json()["scenes"][0]["nodes"] = Json::array();
  }

  int add(const char* array, const Json& object) {
    return static_cast<int>(made_.add(array, object));
  }
  int accessor(const char* type, int component, std::size_t count, const std::string& bytes,
               const Json& more = Json::object()) {
    return static_cast<int>(made_.accessor(type, component, count, bytes, more));
  }
  /// Index of a buffer view of these bytes.
  int add_view(const std::string& bytes) { return static_cast<int>(made_.view(bytes)); }
  /// Positions with the bounds that they have.
  int positions(const SharedArray<Float3>& points) {
    Float3 least = points.front();
    Float3 greatest = least;
    for (const Float3& p : points) {
      for (std::size_t i = 0; i < 3; ++i) {
        least[i] = std::min(least[i], p[i]);
        greatest[i] = std::max(greatest[i], p[i]);
      }
    }
    return accessor("VEC3", 5126, points.size(), packed(points),
                    {{"min", least}, {"max", greatest}});
  }
  int material(const Json& material) {
    if (material.contains("extensions")) {
      for (const auto& [name, value] : material["extensions"].items()) uses(name);
    }
    return add("materials", material);
  }
  void uses(const std::string& extension) {
    for (const Json& each : json().value("extensionsUsed", Json::array())) {
      if (each == extension) return;
    }
    json()["extensionsUsed"].push_back(extension);
  }
  /// Index of the mesh. `material` below 0: none.
  int mesh(const render::Mesh& from, int material) {
    std::vector<std::uint32_t> indices;
    for (const auto& triangle : from.triangles) {
      indices.insert(indices.end(), triangle.begin(), triangle.end());
    }
    Json attributes{{"POSITION", positions(from.positions)}};
    if (!from.normals.empty()) {
      attributes["NORMAL"] = accessor("VEC3", 5126, from.normals.size(), packed(from.normals));
    }
    for (std::size_t i = 0; i < from.uvs.size(); ++i) {
      attributes["TEXCOORD_" + std::to_string(i)] =
          accessor("VEC2", 5126, from.uvs[i].size(), packed(from.uvs[i]));
    }
    Json primitive{{"attributes", attributes},
                   {"indices", accessor("SCALAR", 5125, indices.size(), packed(indices))}};
    if (material >= 0) primitive["material"] = material;
    return add("meshes", {{"primitives", Json::array({primitive})}});
  }
  /// A node of the scene.
  int node(const Json& node) {
    const int index = add("nodes", node);
    json()["scenes"][0]["nodes"].push_back(index);
    return index;
  }
  int draw(const render::Mesh& mesh, const Json& material, Json place = Json::object()) {
    place["mesh"] = this->mesh(mesh, this->material(material));
    return node(place);
  }
  void light(const Json& light, Json place = Json::object()) {
    uses("KHR_lights_punctual");
    json()["extensions"]["KHR_lights_punctual"]["lights"].push_back(light);
    place["extensions"]["KHR_lights_punctual"]["light"] =
        json()["extensions"]["KHR_lights_punctual"]["lights"].size() - 1;
    node(place);
  }
  /// Looks down -z from there, unless turned.
  void camera(const Json& camera, const Json& place) {
    Json object = place;
    object["camera"] = add("cameras", camera);
    node(object);
  }
  void orthographic(double half, double z) {
    camera({{"type", "orthographic"},
            {"orthographic", {{"xmag", half}, {"ymag", half}, {"znear", 0.01}, {"zfar", 1000}}}},
           {{"translation", {0, 0, z}}});
  }

  Json& json() { return made_.json; }
  std::string text() const { return made_.text(buffer_uri(made_.bytes)); }

 private:
  AssetBuilder made_;
};

/// What a metallic-roughness material is without its metal.
inline Json dielectric(const Json& color, double roughness, const Json& extensions = {}) {
  Json material{
      {"pbrMetallicRoughness",
       {{"baseColorFactor", color}, {"metallicFactor", 0}, {"roughnessFactor", roughness}}}};
  if (!extensions.is_null()) material["extensions"] = extensions;
  return material;
}

/// A material of no account.
inline Json plastic() { return dielectric({0.8, 0.5, 0.3, 1}, 0.5); }

inline render::Mesh scaled(render::Mesh mesh, float factor) {
  for (auto& p : mesh.positions) {
    for (float& part : p) part *= factor;
  }
  return mesh;
}

/// Neither mirrors nor shines: all that is scattered is diffuse.
inline Json no_specular() { return {{"KHR_materials_specular", {{"specularFactor", 0}}}}; }

/// The numbers of a picture in OpenEXR.
struct Numbers {
  std::uint32_t width = 0, height = 0, channels = 0;
  std::vector<float> values;

  double at(std::uint32_t x, std::uint32_t y, std::uint32_t c = 0) const {
    return static_cast<double>(values.at((std::size_t{y} * width + x) * channels + c));
  }
  double mean(std::uint32_t c) const {
    double sum = 0;
    for (std::size_t i = c; i < values.size(); i += channels) sum += static_cast<double>(values[i]);
    return sum * channels / static_cast<double>(values.size());
  }
};

inline std::string file_content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline Numbers read_numbers(const std::filesystem::path& path) {
  const std::string file = file_content(path);
  codec::ImageRequest request;
  request.bytes = std::as_bytes(std::span(file));
  request.format = codec::ImageFormat::openexr;
  request.pixels = true;
  const auto result = codec::Client::shared().decode_image(request);
  const auto* image = std::get_if<codec::Image>(&result);
  EXPECT_NE(image, nullptr) << path;
  if (image == nullptr) return {};
  EXPECT_EQ(image->bits, 32U);
  Numbers numbers{image->width, image->height, image->channels, {}};
  numbers.values.resize(image->pixels.size() / sizeof(float));
  std::memcpy(numbers.values.data(), image->pixels.data(), image->pixels.size());
  return numbers;
}

/// Writes assets and draws them: without denoiser, through their first camera, on one thread.
class Baking : public testing::Test {
 protected:
  Baking() {
    options.sizes = {{8, 8}};
    options.samples = 16;
    options.denoise = false;
    options.cameras = {"0"};
    options.jobs = 1;
  }

  /// Light of that radiance from everywhere; 0 is darkness.
  void surround(float radiance) {
    options.environment = (folder.path() / "sky.exr").native();
    const preview::Picture sky{2, 1, 3, {}, std::vector<float>(6, radiance)};
    EXPECT_FALSE(write_picture(sky, options.environment));
  }

  BakeReport report(AssetText& asset) {
    return bake_file(folder.write("asset.gltf", asset.text()).native(), options);
  }
  /// The picture as OpenEXR has it.
  Numbers bake(AssetText& asset) {
    options.output = (folder.path() / "picture.exr").native();
    const BakeReport done = report(asset);
    EXPECT_EQ(done.problem, BakeProblem::none) << done.error << ": " << first_error(done);
    return done.problem == BakeProblem::none ? read_numbers(options.output) : Numbers();
  }
  static std::string first_error(const BakeReport& report) {
    return report.validation.diagnostics.empty() ? std::string()
                                                 : report.validation.diagnostics[0].message;
  }

  const container::test::TempFolder folder;
  BakeOptions options;
};

}  // namespace gltfx::test
