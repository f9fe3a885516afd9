// SPDX-License-Identifier: Apache-2.0
/// edit_buffer POINTER PICTURE [PATH=FILE...]: fixes and upgrades standard input, an asset that is
/// not a file, deletes the object at the JSON pointer, and prints the new asset; then inspects it
/// and draws it to PICTURE, a PNG. Each FILE holds the bytes of the asset's PATH. Exit code 1: a
/// step failed.
#include <gltfx/pipeline.hpp>

#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace {

std::string rest_of(std::istream& stream) {
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

gltfx::MemoryAsset asset_of(int argc, char** argv) {
  gltfx::MemoryAsset asset;
  asset.bytes = rest_of(std::cin);
  asset.name = "upload";
  for (int i = 3; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t equals = argument.find('=');
    if (equals == std::string::npos) continue;
    std::ifstream file(argument.substr(equals + 1), std::ios::binary);
    asset.files[argument.substr(0, equals)] = rest_of(file);
  }
  return asset;
}

// Replaces the old asset and its files with the new ones.
template <class Report>
Report take(gltfx::EditedBytes<Report> edited, gltfx::MemoryAsset& asset) {
  if (edited.report.problem != gltfx::EditProblem::none) {
    throw std::runtime_error(edited.report.error);
  }
  asset.bytes = std::move(edited.bytes);
  for (auto& [path, bytes] : edited.files) asset.files[path] = std::move(bytes);
  return std::move(edited.report);
}

void run(int argc, char** argv) {
  gltfx::MemoryAsset asset = asset_of(argc, argv);
  const gltfx::FixReport fixed = take(gltfx::fix_bytes(asset), asset);
  const gltfx::UpgradeReport upgraded = take(gltfx::upgrade_bytes(asset), asset);
  gltfx::DeleteOptions deletion;
  deletion.pointers = {argv[1]};
  deletion.cascade = true;
  const gltfx::DeleteReport deleted = take(gltfx::delete_objects_in_bytes(asset, deletion), asset);
  std::cout << asset.bytes;

  const gltfx::InspectReport inspected = gltfx::inspect_bytes(asset);
  if (!inspected.facts) throw std::runtime_error(inspected.error);
  std::cerr << fixed.fixed() << " fixed, " << upgraded.due() - upgraded.left() << " upgraded, "
            << deleted.deleted.size() << " deleted, " << inspected.facts->materials.size()
            << " materials left\n";

  gltfx::BakeOptions picture;
  picture.sizes = {{128, 128}};
  picture.quality = gltfx::BakeQuality::draft;
  const gltfx::BakedBytes drawn = gltfx::bake_bytes(asset, picture);
  if (drawn.report.problem != gltfx::BakeProblem::none) {
    throw std::runtime_error(drawn.report.error);
  }
  std::ofstream(argv[2], std::ios::binary) << drawn.pictures.at("");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  try {
    run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
