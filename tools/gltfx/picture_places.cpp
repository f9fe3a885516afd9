// SPDX-License-Identifier: Apache-2.0
#include "picture_places.hpp"

#include <filesystem>
#include <map>
#include <system_error>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

// "a/b.glb" to "a/b.png"; with both an a/b.glb and an a/b.gltf the whole names stay.
std::vector<std::string> picture_names(const std::vector<std::string>& places,
                                       const std::string& format) {
  std::map<std::string, int> uses;
  for (const std::string& place : places) ++uses[fs::path(place).replace_extension().native()];
  std::vector<std::string> names;
  for (const std::string& place : places) {
    const std::string stem = fs::path(place).replace_extension().native();
    names.push_back(fmt::format("{}.{}", uses[stem] > 1 ? place : stem, format));
  }
  return names;
}

bool is_folder(const Inputs& inputs, const std::string& output) {
  std::error_code fault;
  return inputs.several || output.ends_with('/') || fs::is_directory(output, fault);
}

}  // namespace

Result<PicturePlaces> place_pictures(const Inputs& inputs, const BakeRequest& request) {
  const std::string& output = request.bake.output;
  PicturePlaces places;
  places.sheet = request.sheet;
  const bool folder = !output.empty() && is_folder(inputs, output);
  std::error_code fault;
  if (folder && fs::exists(output, fault) && !fs::is_directory(output, fault)) {
    return Error{fmt::format("--output: {} is a file, but a folder is needed for several assets.",
                             quoted(output, 200))};
  }
  const std::vector<std::string> names = picture_names(inputs.places, request.format);
  for (std::size_t i = 0; i < inputs.paths.size(); ++i) {
    const std::string place = folder ? (fs::path(output) / names[i]).native() : output;
    if (!place.empty() && fs::equivalent(place, inputs.paths[i], fault)) {
      return Error{fmt::format("--output: {} is the asset itself.", quoted(place, 200))};
    }
    places.inputs.push_back({inputs.paths[i], place});
  }
  if (folder && inputs.several && places.sheet.empty()) {
    places.sheet = (fs::path(output) / "contact-sheet.png").native();
  }
  return places;
}

}  // namespace gltfx::tool
