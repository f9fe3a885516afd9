// SPDX-License-Identifier: Apache-2.0
#include "pipeline/picture_names.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/text.hpp"
#include "pipeline/bake_names.hpp"

namespace gltfx {
namespace {

constexpr std::size_t kDigits = 3;  // of the number of a frame, at least

}  // namespace

std::string shot_suffix(const BakeOptions& options, const std::string& camera,
                        const BakeSize& size) {
  std::string suffix = camera.empty() ? std::string() : "." + camera;
  if (options.sizes.size() > 1) suffix += fmt::format("-{}x{}", size.width, size.height);
  return suffix;
}

std::string frame_suffix(std::size_t number) { return fmt::format("-{:0{}}", number, kDigits); }

std::string layer_suffix(BakeLayer layer) { return fmt::format("-{}", bake_layer_name(layer)); }

std::vector<std::string> camera_parts(const BakeOptions& options) {
  if (options.cameras.size() < 2) return std::vector<std::string>(options.cameras.size());
  return camera_file_parts(options.cameras);
}

BakeLayout layout_of(const BakeOptions& options, bool has_frames, bool webp) {
  // Of an asset that lacks the clip, whatever the layout.
  if (!has_frames && !options.clip.empty()) return BakeLayout::files;
  if (options.layout != BakeLayout::automatic) return options.layout;
  return webp && has_frames ? BakeLayout::animation : BakeLayout::files;
}

PossibleSuffixes possible_suffixes(const BakeOptions& options, bool webp) {
  std::vector<std::string> cameras = camera_parts(options);
  const bool always =  // an asset has one of them
      !options.cameras.empty() &&
      (!options.if_present ||
       std::any_of(options.cameras.begin(), options.cameras.end(), is_for_any_asset));
  if (!always) cameras.emplace_back();
  const bool has_frames = options.turntable > 0 || !options.clip.empty();
  const bool numbered = has_frames && layout_of(options, true, webp) == BakeLayout::files;
  const bool single = !numbered || (options.if_present && !options.clip.empty());
  std::vector<std::string> layers{""};
  for (const BakeLayer layer : options.layers) layers.push_back(layer_suffix(layer));
  PossibleSuffixes all;
  for (const std::string& camera : cameras) {
    for (const BakeSize& size : options.sizes) {
      for (const std::string& layer : layers) {
        const std::string shot = shot_suffix(options, camera, size);
        if (single) all.single.push_back(shot + layer);
        if (numbered) all.numbered.push_back(shot + "-#" + layer);
      }
    }
  }
  return all;
}

std::string with_any_number(std::string name) {
  std::string layer;
  for (const BakeLayer each :
       {BakeLayer::albedo, BakeLayer::normal, BakeLayer::depth, BakeLayer::material}) {
    const std::string ending = layer_suffix(each);
    if (!name.ends_with(ending)) continue;
    layer = ending;
    name.resize(name.size() - ending.size());
    break;
  }
  const std::size_t before = name.find_last_not_of("0123456789");
  const std::size_t digits = before == std::string::npos ? 0 : name.size() - 1 - before;
  if (digits >= kDigits && name[before] == '-') name.replace(before + 1, digits, "#");
  return name + layer;
}

std::string with_suffix(const std::string& path, std::string_view suffix) {
  const std::filesystem::path whole(path);
  const std::filesystem::path name =
      whole.stem().native() + std::string(suffix) + whole.extension().native();
  return (whole.parent_path() / name).native();
}

}  // namespace gltfx
