// SPDX-License-Identifier: Apache-2.0
// Every sound fixture as a model of tinygltf and back: what differs was reported.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "document_diff.hpp"
#include "support.hpp"

namespace gltfx::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const char* folder : {"good", "legacy"}) {
    for (const auto& entry : fs::directory_iterator(fixture(folder))) {
      const fs::path extension = entry.path().extension();
      if (extension != ".gltf" && extension != ".glb") continue;
      all.push_back(folder / entry.path().filename());
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

// Bytes may move, and decoded ones are in new views and buffers.
bool is_storage(const std::string& pointer) {
  if (pointer.starts_with("/buffers/") || pointer.starts_with("/bufferViews/")) return true;
  if (pointer.starts_with("/extensionsUsed") || pointer.starts_with("/extensionsRequired")) {
    return true;
  }
  return pointer.starts_with("/images/") &&
         (pointer.ends_with("/uri") || pointer.ends_with("/mimeType"));
}

bool is_reported(const std::string& pointer, const std::vector<TinygltfNote>& notes) {
  return std::any_of(notes.begin(), notes.end(), [&](const TinygltfNote& note) {
    const std::string around = note.pointer.substr(0, note.pointer.find("/extensions/"));
    return pointer.starts_with(note.pointer) || note.pointer.starts_with(pointer) ||
           (around != note.pointer && pointer.starts_with(around));
  });
}

// Without the old parameters, which distinguish a default from a missing member.
std::vector<tinygltf::Material> materials_of(tinygltf::Model model) {
  for (tinygltf::Material& material : model.materials) {
    material.values.clear();
    material.additionalValues.clear();
  }
  return model.materials;
}

class RoundTrip : public testing::TestWithParam<std::string> {
 protected:
  fs::path path() const { return fixture(GetParam()); }
};

TEST_P(RoundTrip, ChangesNothingThatWasNotReported) {
  for (const char* form : {"back.gltf", "back.glb"}) {
    tinygltf::Model model;
    const TinygltfReport there = to_tinygltf(path().native(), model, {});
    ASSERT_TRUE(there.done) << problems(there);
    MemoryAsset back;
    back.name = form;
    const TinygltfReport again = from_tinygltf(model, back, {});
    ASSERT_TRUE(again.done) << problems(again);
    std::vector<TinygltfNote> notes = there.notes;
    notes.insert(notes.end(), again.notes.begin(), again.notes.end());
    const bool decoded = !pointers(there.notes, false).empty();
    for (const std::string& pointer : differences(json_of(content(path())), json_of(back.bytes))) {
      if (is_storage(pointer) && (decoded || !pointer.starts_with("/bufferViews/"))) continue;
      // Accessors of decoded geometry show other views.
      if (decoded && pointer.starts_with("/accessors/")) continue;
      EXPECT_TRUE(is_reported(pointer, notes)) << pointer;
    }
  }
}

TEST_P(RoundTrip, GivesTheSameModelAgain) {
  const tinygltf::Model model = model_of(path());
  MemoryAsset back;
  back.name = "back.glb";
  const TinygltfReport there = from_tinygltf(model, back, {});
  ASSERT_TRUE(there.done) << problems(there);
  tinygltf::Model again;
  const TinygltfReport report = to_tinygltf(back, again, {});
  ASSERT_TRUE(report.done) << problems(report);
  EXPECT_TRUE(again.accessors == model.accessors);
  EXPECT_TRUE(again.meshes == model.meshes);
  EXPECT_TRUE(materials_of(again) == materials_of(model));
  EXPECT_TRUE(again.nodes == model.nodes);
  EXPECT_TRUE(again.animations == model.animations);
  EXPECT_TRUE(again.extensions == model.extensions);
  ASSERT_EQ(again.buffers.size(), model.buffers.size());
  for (std::size_t i = 0; i < model.buffers.size(); ++i) {
    EXPECT_TRUE(again.buffers[i].data == model.buffers[i].data) << i;
  }
  ASSERT_EQ(again.images.size(), model.images.size());
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    EXPECT_TRUE(again.images[i].image == model.images[i].image) << i;
  }
}

TEST_P(RoundTrip, BytesOfTheModelHaveTheBoundsOfItsAccessors) {
  ToTinygltfOptions options;
  options.expand_sparse = true;
  const tinygltf::Model model = model_of(path(), options);
  for (const tinygltf::Accessor& accessor : model.accessors) {
    if (accessor.bufferView < 0) continue;
    for (std::size_t k = 0; k < accessor.maxValues.size(); ++k) {
      double least = INFINITY, most = -INFINITY;
      for (std::size_t i = 0; i < accessor.count; ++i) {
        const double value = component_at(model, accessor, i, k);
        least = std::min(least, value);
        most = std::max(most, value);
      }
      EXPECT_EQ(static_cast<float>(accessor.minValues.at(k)), static_cast<float>(least));
      EXPECT_EQ(static_cast<float>(accessor.maxValues.at(k)), static_cast<float>(most));
    }
  }
}

TEST_P(RoundTrip, IndicesOfTheModelLeadToVertices) {
  const tinygltf::Model model = model_of(path());
  for (const tinygltf::Mesh& mesh : model.meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const auto positions = primitive.attributes.find("POSITION");
      if (primitive.indices < 0 || positions == primitive.attributes.end()) continue;
      const auto& indices = model.accessors.at(static_cast<std::size_t>(primitive.indices));
      const auto& vertices = model.accessors.at(static_cast<std::size_t>(positions->second));
      for (std::size_t i = 0; i < indices.count; ++i) {
        EXPECT_LT(component_at(model, indices, i, 0), static_cast<double>(vertices.count));
      }
    }
  }
}

// What tinygltf reads itself is read alike.
TEST_P(RoundTrip, IsWhatTinygltfReads) {
  const nlohmann::json document = json_of(content(path()));
  const std::string text = document.dump();
  for (const char* compressed : {"_meshopt_", "KHR_draco", "KHR_texture_basisu", "webp"}) {
    if (text.find(compressed) != std::string::npos) GTEST_SKIP() << "not read by it";
  }
  tinygltf::TinyGLTF loader;
  tinygltf::Model expected;
  std::string error, warning;
  const bool loaded = path().extension() == ".glb"
                          ? loader.LoadBinaryFromFile(&expected, &error, &warning, path().native())
                          : loader.LoadASCIIFromFile(&expected, &error, &warning, path().native());
  ASSERT_TRUE(loaded) << error;
  const tinygltf::Model model = model_of(path());
  EXPECT_TRUE(model.accessors == expected.accessors);
  // It leaves out channels that move no node.
  if (text.find("KHR_animation_pointer") == std::string::npos) {
    EXPECT_TRUE(model.animations == expected.animations);
  }
  EXPECT_TRUE(model.asset == expected.asset);
  EXPECT_TRUE(model.bufferViews == expected.bufferViews);
  EXPECT_TRUE(model.cameras == expected.cameras);
  EXPECT_TRUE(model.materials == expected.materials);
  EXPECT_TRUE(model.meshes == expected.meshes);
  EXPECT_TRUE(model.nodes == expected.nodes);
  EXPECT_TRUE(model.samplers == expected.samplers);
  EXPECT_TRUE(model.scenes == expected.scenes);
  EXPECT_TRUE(model.skins == expected.skins);
  EXPECT_TRUE(model.textures == expected.textures);
  EXPECT_TRUE(model.extensions == expected.extensions);
  EXPECT_EQ(model.defaultScene, expected.defaultScene);
  EXPECT_EQ(model.extensionsUsed, expected.extensionsUsed);
  ASSERT_EQ(model.lights.size(), expected.lights.size());
  for (std::size_t i = 0; i < model.lights.size(); ++i) {
    EXPECT_EQ(model.lights[i].intensity, expected.lights[i].intensity);
    EXPECT_EQ(model.lights[i].spot.outerConeAngle, expected.lights[i].spot.outerConeAngle);
  }
  ASSERT_EQ(model.buffers.size(), expected.buffers.size());
  for (std::size_t i = 0; i < model.buffers.size(); ++i) {
    EXPECT_TRUE(model.buffers[i].data == expected.buffers[i].data);
  }
  ASSERT_EQ(model.images.size(), expected.images.size());
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    if (expected.images[i].mimeType == "image/jpeg") continue;  // decoders differ by rounding
    EXPECT_EQ(model.images[i].width, expected.images[i].width);
    EXPECT_EQ(model.images[i].component, expected.images[i].component);
    EXPECT_TRUE(model.images[i].image == expected.images[i].image) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Fixtures, RoundTrip, testing::ValuesIn(names()), [](const auto& param) {
  std::string name = param.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
  return name;
});

}  // namespace
}  // namespace gltfx::test
