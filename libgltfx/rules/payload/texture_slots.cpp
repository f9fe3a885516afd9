// SPDX-License-Identifier: Apache-2.0
#include "rules/payload/texture_slots.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"
#include "container/uri.hpp"
#include "model/fields.hpp"
#include "model/texture.hpp"
#include "rules/core/material_needs.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

void read_pair(const json::Document& document, json::NodeId object, std::string_view member,
               std::array<double, 2>& pair) {
  const json::NodeId value = document.find(object, member);
  if (value == json::kNoNode || document.kind(value) != json::Kind::number_array) return;
  std::size_t at = 0;
  for (json::NumberCursor number(document, value); number.valid() && at < 2; number.advance()) {
    pair[at++] = number.number().value;
  }
}

// `object` is an extension of the texture info.
void read_transform(const json::Document& document, json::NodeId object, UvMapping& mapping) {
  const auto set = model::number_member(document, object, "texCoord");
  mapping.texcoord = set.value_or(mapping.texcoord);
  const auto rotation = model::number_member(document, object, "rotation");
  mapping.rotation = rotation.value_or(mapping.rotation);
  read_pair(document, object, "offset", mapping.offset);
  read_pair(document, object, "scale", mapping.scale);
}

using model::object_member;
using model::RootArray;

// The numbers of a JSON text "0.5" or "[1, 1, 1]": defaults in schema files.
std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    double value = 0;
    const auto read = read_double(at, end, value);
    if (read.ec == std::errc()) numbers.push_back(value);
    at = read.ec == std::errc() ? read.ptr : at + 1;
  }
  return numbers;
}

std::vector<double> numbers_at(const json::Document& document, json::NodeId value) {
  std::vector<double> numbers;
  if (document.is_number(value)) numbers.push_back(document.number(value).value);
  if (document.kind(value) != json::Kind::number_array) return numbers;
  for (json::NumberCursor at(document, value); at.valid() && numbers.size() < 4; at.advance()) {
    numbers.push_back(at.number().value);
  }
  return numbers;
}

class SlotReader {
 public:
  SlotReader(const Context& context, const Animated& animated)
      : context_(context),
        document_(context.document),
        animated_(animated),
        images_(context.asset.count(RootArray::textures)) {}

  std::optional<TextureSlot> read(const schema::SlotUse& use) {
    const auto texture = context_.asset.index(use.texture_info, "index", RootArray::textures);
    if (!texture || use.slot == nullptr) return std::nullopt;
    TextureSlot slot;
    slot.use = &use;
    slot.texture = *texture;
    slot.property = std::string_view(use.pointer).substr(use.pointer.rfind('/') + 1);
    const json::NodeId object = context_.asset.elements(RootArray::textures)[*texture];
    slot.sampler = context_.asset.index(object, "sampler", RootArray::samplers);
    slot.images = images_of(*texture, object);
    if (slot.images.empty()) return std::nullopt;
    read_material(slot);
    slot.srgb = use.slot->srgb;
    slot.coverage = schema::has_coverage(context_.schemas, use);
    slot.normal_map = model::is_normal_map(slot.property);
    slot.channels = ChannelSet(use.slot->channels);
    if (slot.coverage && alpha_mode(slot) == "OPAQUE") slot.channels.remove('a');
    slot.effective = slot.channels;
    hide_by_factors(slot);
    return slot;
  }

 private:
  // The maximum number of formats of a texture.
  static constexpr std::size_t kMostImages = 8;

  using Images = std::vector<std::uint32_t>;

  void add_image(json::NodeId object, Images& images) const {
    const auto source = context_.asset.index(object, "source", RootArray::images);
    if (source && images.size() < kMostImages) images.push_back(*source);
  }

  // An extension may add an image of another format. Read once for each texture.
  const Images& images_of(std::uint32_t index, json::NodeId texture) {
    std::optional<Images>& images = images_[index];
    if (images) return *images;
    images.emplace();
    add_image(texture, *images);
    const json::NodeId extensions = object_member(document_, texture, "extensions");
    if (extensions == json::kNoNode) return *images;
    for (const auto member : document_.members(extensions)) {
      if (document_.is_object(member.value)) add_image(member.value, *images);
    }
    return *images;
  }

  void read_material(TextureSlot& slot) const {
    const auto index = material_of(slot.use->pointer);
    const auto& materials = context_.asset.elements(RootArray::materials);
    if (!index || *index >= materials.size()) return;
    slot.material_index = static_cast<std::uint32_t>(*index);
    slot.material = materials[*index];
  }

  std::string alpha_mode(const TextureSlot& slot) const {
    std::string mode = model::string_member(document_, slot.material, "alphaMode");
    return mode.empty() ? "OPAQUE" : mode;
  }

  // Hides channels whose factor is always 0.
  void hide(TextureSlot& slot, std::string_view member, std::string_view names) const {
    if (slot.effective.empty()) return;
    const std::vector<double> factor = factor_of(context_, *slot.use, member);
    if (std::find(factor.begin(), factor.end(), 0.0) == factor.end()) return;
    if (animated_.contains(sibling_pointer(slot, member))) return;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::size_t at = factor.size() == 1 ? 0 : i;
      if (at < factor.size() && factor[at] == 0) slot.effective.remove(names[i]);
    }
    if (slot.effective.empty()) slot.hidden_by = member;
  }

  // The factor that disables the property that the texture is a part of.
  void switch_off(TextureSlot& slot) const {
    const schema::TypeId type = slot.use->owner_type;
    if (type == schema::kNone) return;
    const schema::ExtensionId extension = context_.schemas.type(type).extension;
    if (extension == schema::kNone) return;
    const std::string& member = context_.schemas.extensions()[extension].strength;
    const std::vector<double> factor = factor_of(context_, *slot.use, member);
    const bool off = !factor.empty() && std::all_of(factor.begin(), factor.end(),
                                                    [](double value) { return value == 0; });
    if (!off || slot.effective.empty()) return;
    if (animated_.contains(sibling_pointer(slot, member))) return;
    slot.effective = ChannelSet();
    slot.hidden_by = member;
  }

  // A factor of the slot itself: the scale of a normal map, the strength of occlusion.
  void hide_by_own(TextureSlot& slot, std::string_view member) const {
    const auto factor = model::number_member(document_, slot.use->texture_info, member);
    if (!factor || *factor != 0) return;
    if (animated_.contains(fmt::format("{}/{}", slot.use->pointer, member))) return;
    slot.effective = ChannelSet();
    slot.hidden_by = member;
  }

  void hide_by_factors(TextureSlot& slot) const {
    const std::string& channels = slot.use->slot->channels;
    hide_by_own(slot, "scale");
    hide_by_own(slot, "strength");
    switch_off(slot);
    hide(slot, slot.use->slot->scaled_by, channels);
    for (const auto& [names, factor] : slot.use->slot->factors) hide(slot, factor, names);
  }

  const Context& context_;
  const json::Document& document_;
  const Animated& animated_;
  std::vector<std::optional<Images>> images_;  // by texture
};

}  // namespace

std::string_view UvMapping::difference(const UvMapping& other) const {
  if (texcoord != other.texcoord) return "texCoord";
  const bool same = rotation == other.rotation && offset == other.offset && scale == other.scale;
  return same ? "" : "transform";
}

UvMapping read_uv_mapping(const json::Document& document, json::NodeId texture_info) {
  UvMapping mapping;
  mapping.texcoord = model::number_member(document, texture_info, "texCoord").value_or(0);
  const json::NodeId extensions = model::object_member(document, texture_info, "extensions");
  if (extensions == json::kNoNode) return mapping;
  for (const auto member : document.members(extensions)) {
    if (document.is_object(member.value)) read_transform(document, member.value, mapping);
  }
  return mapping;
}

ChannelSet::ChannelSet(std::string_view names) {
  for (const char name : names) bits_ |= bit(name);
}

std::string ChannelSet::text() const {
  std::vector<std::string> names;
  if (has('r')) names.emplace_back("R");
  if (has('g')) names.emplace_back("G");
  if (has('b')) names.emplace_back("B");
  if (has('a')) names.emplace_back("A");
  return join_and(names);
}

std::vector<TextureSlot> texture_slots(const Context& context, const Animated& animated) {
  SlotReader reader(context, animated);
  std::vector<TextureSlot> slots;
  for (const schema::SlotUse& use : context.checked.slots) {
    if (auto slot = reader.read(use)) slots.push_back(*std::move(slot));
  }
  return slots;
}

std::string sibling_pointer(const TextureSlot& slot, std::string_view member) {
  const std::string_view pointer = slot.use->pointer;
  return fmt::format("{}/{}", pointer.substr(0, pointer.rfind('/')), member);
}

std::vector<double> factor_of(const Context& context, const schema::SlotUse& use,
                              std::string_view member) {
  const json::NodeId value = context.document.find(use.owner, member);
  if (value != json::kNoNode) return numbers_at(context.document, value);
  if (use.owner_type == schema::kNone) return {};
  const schema::Property* property = context.schemas.find_property(use.owner_type, member);
  if (property == nullptr || has_unknown_member(context, use.owner_type, use.owner)) return {};
  return numbers_in(property->default_json);
}

bool has_unknown_member(const Context& context, schema::TypeId type, json::NodeId object) {
  if (type == schema::kNone || object == json::kNoNode) return false;
  for (const auto member : context.document.members(object)) {
    const std::string_view name = context.document.key(member.key_id);
    const bool any_object = name == "extras" || name == "extensions";
    if (!any_object && context.schemas.find_property(type, name) == nullptr) return true;
  }
  return false;
}

std::string image_label(const Context& context, std::uint32_t image) {
  const json::NodeId object = context.asset.elements(RootArray::images)[image];
  std::string name = context.asset.name(object);
  const json::NodeId uri = context.document.find(object, "uri");
  const bool readable = uri != json::kNoNode && context.document.is_string(uri);
  if (name.empty() && readable && !context.document.raw(uri).starts_with("\"data:")) {
    const container::Uri parts = container::classify_uri(context.document.string(uri));
    if (parts.kind == container::UriKind::relative_path) name = parts.normalized;
  }
  return name.empty() ? fmt::format("image {}", image)
                      : fmt::format("image {} ({})", image, gltfx::quoted(name));
}

void report_slot(const Context& context, Sink& sink, const TextureSlot& slot, Code code,
                 std::string message, std::string help, std::optional<Severity> severity) {
  Finding finding =
      finding_on(context, slot.use->texture_info, code, std::move(message), std::move(help));
  finding.severity = severity;
  report_at(sink, slot.use->pointer, std::move(finding));
}

}  // namespace gltfx::validate
