// SPDX-License-Identifier: Apache-2.0
/// Fixtures as JSON values and buffers, which tests change and open.
#pragma once

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "container/memory_asset.hpp"
#include "container/opened_files.hpp"
#include "model/opened_asset.hpp"
#include "model/resource_data.hpp"
#include "prove/meaning.hpp"
#include "schema/compile.hpp"

namespace gltfx::test {

using Json = nlohmann::ordered_json;

/// An asset with its buffers as separate files in memory; images stay in their files.
struct EditedAsset {
  Json json;
  std::map<std::string, std::string> files;  ///< by URI
  std::filesystem::path folder;

  /// With one buffer, if `bytes` is not empty.
  static EditedAsset made(const std::string& text, std::string bytes = {}) {
    EditedAsset asset;
    asset.json = Json::parse(text);
    if (bytes.empty()) return asset;
    asset.json["buffers"] = {{{"uri", "buffer0.bin"}, {"byteLength", bytes.size()}}};
    asset.files["buffer0.bin"] = std::move(bytes);
    return asset;
  }

  static EditedAsset load(const std::filesystem::path& path) {
    EditedAsset loaded;
    loaded.folder = path.parent_path();
    auto container = container::open_file(path);
    const model::OpenedAsset opened(path.filename(), *std::move(container),
                                    container::Resolver(loaded.folder, loaded.folder));
    loaded.json = Json::parse(opened.document().text());
    const model::Asset asset(opened.document());
    container::OpenedFiles files(opened.resolver());
    const auto resources =
        model::load_resources(opened.container(), files, asset, opened.views(), 1);
    for (std::size_t i = 0; i < resources.data.buffers.size(); ++i) {
      if (!resources.data.buffers[i]) continue;
      const std::string uri = "buffer" + std::to_string(i) + ".bin";
      loaded.json["buffers"][i]["uri"] = uri;
      loaded.files[uri] = std::string(resources.data.buffers[i]->text());
    }
    return loaded;
  }

  model::OpenedAsset open() const {
    container::Resolver resolver =
        folder.empty() ? container::Resolver() : container::Resolver(folder, folder);
    if (folder.empty()) {
      MemoryAsset memory;
      memory.files = files;
      resolver = container::resolver_of(std::move(memory), {});
    } else {
      for (const auto& [uri, bytes] : files) {
        resolver.add(uri, container::Bytes::from_string(std::string(bytes)));
      }
    }
    return model::OpenedAsset("edited.gltf",
                              container::open_memory(json.dump(), "edited.gltf", AssetFormat::gltf),
                              std::move(resolver));
  }

  /// The first byte of an element of an accessor; null: it is not stored in plain form.
  char* element(std::size_t accessor, std::size_t index) {
    const Json& object = json["accessors"][accessor];
    if (!object.contains("bufferView")) return nullptr;
    const Json& view = json["bufferViews"][object["bufferView"].get<std::size_t>()];
    const Json& buffer = json["buffers"][view["buffer"].get<std::size_t>()];
    if (view.contains("extensions") || !buffer.contains("uri")) return nullptr;
    static const std::map<std::string, std::size_t> kComponents{
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    static const std::map<int, std::size_t> kSizes{{5120, 1}, {5121, 1}, {5122, 2},
                                                   {5123, 2}, {5125, 4}, {5126, 4}};
    const std::size_t size = kComponents.at(object["type"]) * kSizes.at(object["componentType"]);
    const std::size_t at = view.value("byteOffset", 0U) + object.value("byteOffset", 0U) +
                           index * view.value("byteStride", size);
    std::string& bytes = files.at(buffer["uri"]);
    return at + size <= bytes.size() ? bytes.data() + at : nullptr;
  }
};

inline prove::Meaning compare(const EditedAsset& before, const EditedAsset& after,
                              const prove::MeaningRequest& request = {}) {
  return prove::compare_meaning(before.open(), after.open(), *schema::builtin_set(), request);
}

inline std::string text(const prove::Meaning& meaning) {
  std::string all;
  for (const prove::Difference& each : meaning.differences) {
    all.append(each.pointer).append(" ").append(each.what).append("\n");
  }
  return all;
}

enum class Depth { folder, tree };

inline std::vector<std::filesystem::path> assets_in(const std::filesystem::path& folder,
                                                    Depth depth = Depth::folder) {
  std::vector<std::filesystem::path> paths;
  std::filesystem::recursive_directory_iterator entries(folder);
  for (auto at = begin(entries); at != end(entries); ++at) {
    if (depth == Depth::folder) at.disable_recursion_pending();
    const std::string extension = at->path().extension();
    if (extension == ".gltf" || extension == ".glb") paths.push_back(at->path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace gltfx::test
