// SPDX-License-Identifier: Apache-2.0
#include "model/texture.hpp"

#include <algorithm>

#include "model/fields.hpp"

namespace gltfx::model {
namespace {

constexpr std::uint64_t kNearest = 9728;
constexpr std::uint64_t kLinear = 9729;
constexpr std::uint64_t kNearestMipmapNearest = 9984;
constexpr std::uint64_t kLinearMipmapLinear = 9987;
constexpr std::uint64_t kClampToEdge = 33071;
constexpr std::uint64_t kMirroredRepeat = 33648;

Wrap read_wrap(const json::Document& document, json::NodeId sampler, std::string_view name) {
  const auto number = unsigned_member(document, sampler, name);
  if (number == kClampToEdge) return Wrap::clamp_to_edge;
  return number == kMirroredRepeat ? Wrap::mirrored_repeat : Wrap::repeat;
}

// 9984 to 9987 vary the filter within a mipmap first, then the filter between mipmaps.
void read_minify(std::uint64_t number, Sampler& sampler) {
  if (number == kNearest || number == kLinear) {
    sampler.mipmaps = false;
    sampler.minify = number == kLinear ? Filter::linear : Filter::nearest;
  } else if (number >= kNearestMipmapNearest && number <= kLinearMipmapLinear) {
    const std::uint64_t bits = number - kNearestMipmapNearest;
    sampler.minify = static_cast<Filter>(bits & 1U);
    sampler.between_mipmaps = static_cast<Filter>(bits >> 1U);
  }
}

Sampler read_sampler(const json::Document& document, json::NodeId object) {
  Sampler sampler;
  sampler.wrap_s = read_wrap(document, object, "wrapS");
  sampler.wrap_t = read_wrap(document, object, "wrapT");
  if (unsigned_member(document, object, "magFilter") == kNearest) sampler.magnify = Filter::nearest;
  read_minify(unsigned_member(document, object, "minFilter").value_or(kLinearMipmapLinear),
              sampler);
  return sampler;
}

void add_image(const Asset& asset, json::NodeId object, std::vector<std::uint32_t>& images) {
  const auto image = asset.index(object, "source", RootArray::images);
  if (image && std::find(images.begin(), images.end(), *image) == images.end()) {
    images.push_back(*image);
  }
}

}  // namespace

// Extensions that add a format have a `source` for its image, whatever their name.
Texture read_texture(const Asset& asset, json::NodeId object) {
  const json::Document& document = asset.document();
  Texture texture;
  const json::NodeId extensions = object_member(document, object, "extensions");
  if (extensions != json::kNoNode) {
    for (const auto extension : document.members(extensions)) {
      add_image(asset, extension.value, texture.images);
    }
  }
  add_image(asset, object, texture.images);
  if (const auto sampler = asset.index(object, "sampler", RootArray::samplers)) {
    texture.sampler = read_sampler(document, asset.elements(RootArray::samplers)[*sampler]);
  }
  return texture;
}

bool is_normal_map(std::string_view slot) {
  return slot == "normalTexture" || slot.ends_with("NormalTexture");
}

TextureSlot read_slot(const Asset& asset, const Properties& owner, std::string_view name) {
  TextureSlot slot;
  const Properties info = owner.object(name);
  if (!info.exists()) return slot;
  slot.texture = asset.index(info.node(), "index", RootArray::textures);
  const Properties transform = info.extension("KHR_texture_transform");
  slot.offset = transform.numbers<2>("offset", {0, 0});
  slot.rotation = transform.number("rotation", 0);
  slot.scale = transform.numbers<2>("scale", {1, 1});
  auto set = unsigned_member(asset.document(), transform.node(), "texCoord");
  if (!set) set = unsigned_member(asset.document(), info.node(), "texCoord");
  slot.tex_coord = static_cast<std::uint32_t>(std::min<std::uint64_t>(set.value_or(0), UINT32_MAX));
  return slot;
}

}  // namespace gltfx::model
