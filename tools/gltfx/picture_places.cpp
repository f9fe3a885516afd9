// SPDX-License-Identifier: Apache-2.0
#include "picture_places.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "base/text.hpp"
#include "output.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

// "a/b.glb" to "a/b.png"; with both an a/b.glb and an a/b.gltf the whole names stay.
std::vector<std::string> picture_names(const Inputs& inputs, const std::string& format) {
  std::map<std::string, int> uses;
  for (const auto* places : {&inputs.places, &inputs.places_of_others}) {
    for (const std::string& place : *places) ++uses[fs::path(place).replace_extension().native()];
  }
  std::vector<std::string> names;
  for (const std::string& place : inputs.places) {
    const std::string stem = fs::path(place).replace_extension().native();
    names.push_back(fmt::format("{}.{}", uses[stem] > 1 ? place : stem, format));
  }
  return names;
}

bool is_folder(const Inputs& inputs, const std::string& output) {
  std::error_code error;
  return inputs.several || output.ends_with('/') || fs::is_directory(output, error);
}

// An ending that is none of a picture, or another one than --format names.
std::optional<Error> check_name(const char* option, const std::string& name,
                                const std::string& format) {
  if (name.empty()) return std::nullopt;
  if (const std::string wrong = check_picture_name(name); !wrong.empty()) {
    return Error{fmt::format("{}: {}.", option, wrong)};
  }
  if (format == "png" || name.ends_with(format)) return std::nullopt;
  return Error{fmt::format("--format: that is for files in a folder; the name {} says another one.",
                           quoted(name, 200))};
}

}  // namespace

Result<PicturePlaces> place_pictures(const Inputs& inputs, const BakeRequest& request) {
  const std::string& output = request.bake.output;
  PicturePlaces places;
  if (!inputs.paths.empty()) places.sheet = request.sheet;
  const bool folder = !output.empty() && is_folder(inputs, output);
  std::error_code error;
  if (folder && fs::exists(output, error) && !fs::is_directory(output, error)) {
    return Error{fmt::format("--output: {} is a file, but a folder is needed for several assets.",
                             quoted(output, 200))};
  }
  const bool to_be_made = folder && !output.ends_with('/') && !fs::exists(output, error);
  if (to_be_made && check_picture_name(output).empty()) {
    return Error{fmt::format(
        "--output: {} is called like one picture, but several assets may come; end it in '/' if it "
        "is to be a folder.",
        quoted(output, 200))};
  }
  if (!folder) {
    if (const auto wrong = check_name("--output", output, request.format)) return *wrong;
  }
  if (const auto wrong = check_name("--sheet", request.sheet, "png")) return *wrong;
  if (!folder && !request.sheet.empty() && same_place(request.sheet, output)) {
    return Error{fmt::format("--sheet: {} is where --output writes.", quoted(request.sheet, 200))};
  }
  const std::vector<std::string> names = picture_names(inputs, request.format);
  for (std::size_t i = 0; i < inputs.paths.size(); ++i) {
    const std::string place = folder ? (fs::path(output) / names[i]).native() : output;
    if (!place.empty() && fs::equivalent(place, inputs.paths[i], error)) {
      return Error{fmt::format("--output: {} is the asset itself.", quoted(place, 200))};
    }
    places.inputs.push_back({inputs.paths[i], place});
  }
  const bool all = request.paths.shard.count <= 1 && !inputs.paths.empty();
  if (folder && all && inputs.several && places.sheet.empty()) {
    places.sheet = (fs::path(output) / "contact-sheet.png").native();
  }
  return places;
}

}  // namespace gltfx::tool
