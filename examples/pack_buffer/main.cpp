// SPDX-License-Identifier: Apache-2.0
/// pack_buffer [PATH=FILE...]: reads a .gltf from standard input and prints it as one GLB. Each
/// FILE is the file that the asset calls PATH. Exit code 1: something cannot be packed; 2: a FILE
/// cannot be read.
#include <gltfx/pipeline.hpp>

#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <utility>

namespace {

std::string rest_of(std::istream& stream) {
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

}  // namespace

int main(int argc, char** argv) {
  gltfx::MemoryAsset asset;
  asset.bytes = rest_of(std::cin);
  asset.name = "upload.gltf";
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t equals = argument.find('=');
    if (equals == std::string::npos) return 2;
    std::ifstream file(argument.substr(equals + 1), std::ios::binary);
    if (!file) return 2;
    asset.files[argument.substr(0, equals)] = rest_of(file);
  }
  gltfx::ConvertOptions options;
  options.to = gltfx::StoredAs::glb;
  const gltfx::EditedBytes<gltfx::ConvertReport> packed =
      gltfx::convert_bytes(std::move(asset), options);
  for (const gltfx::ConvertStep& step : packed.report.steps) {
    std::cerr << step.step << ": " << step.what << '\n';
  }
  if (packed.report.problem != gltfx::EditProblem::none) {
    std::cerr << packed.report.error << '\n';
    return 1;
  }
  std::cout << packed.bytes;
  return 0;
}
